#!/usr/bin/env -S julia --startup-file=no --threads=auto
# SPDX-License-Identifier: MIT
#
# ImplicitBVH.jl as a program for bvhbench (docs/plugins.md). It was written from the package's documentation and has not been run.
# The first call compiles; the frames before the samples take that.
using ImplicitBVH, JSON
using ImplicitBVH: BBox

read_array(path, type) = reshape(reinterpret(type, read(path)), 3, :)
faces = points = nothing
contacts = []

function query()
    first = time_ns()
    leaves = [BBox{Float32}(vec(minimum(points[:, face .+ 1]; dims=2)), vec(maximum(points[:, face .+ 1]; dims=2))) for face in eachcol(faces)]
    second = time_ns()
    bvh = BVH(leaves, BBox{Float32}, UInt32)
    third = time_ns()
    global contacts = traverse(bvh).contacts
    stage(name, from, to) = Dict("name" => name, "begin_ns" => from, "end_ns" => to, "device" => false)
    return Dict("stages" => [stage("bounds", first, second), stage("build", second, third), stage("broad", third, time_ns())])
end

function reply(request)
    call = request["call"]
    call == "hello" && return Dict("protocol" => 1, "library" => "ImplicitBVH.jl", "version" => string(pkgversion(ImplicitBVH)),
        "licence" => "MIT", "device" => "host", "methods" => [Dict("name" => "implicitbvh", "summary" => "ImplicitBVH.jl, on all threads",
        "query" => true, "pairs" => true)])
    call == "prepare" && (global faces = read_array(request["faces"], UInt32))
    call == "load" && (global points = read_array(request["points"], Float32))
    call == "query" && return query()
    call == "bytes" && return Dict("bytes" => 0)
    if call == "pairs"
        open(request["pairs"], "w") do file
            foreach(pair -> write(file, UInt32(pair[1] - 1), UInt32(pair[2] - 1)), contacts)
        end
        return Dict("count" => length(contacts))
    end
    return Dict()
end

for line in eachline(stdin)
    request = JSON.parse(line)
    request["call"] == "quit" && break
    println(stdout, JSON.json(merge(Dict("ok" => true), reply(request))))
    flush(stdout)
end
