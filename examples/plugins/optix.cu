// SPDX-License-Identifier: MIT
//
// OptiX: acceleration structures over triangles and over boxes. It is for rays alone: no tree is shown, and no pairs are found.
#include "cuda_method.cuh"

#include <optix.h>
#include <optix_function_table_definition.h>
#include <optix_stubs.h>

namespace {

void check(OptixResult result, const char* what)
{
    if (result != OPTIX_SUCCESS)
        throw std::runtime_error(std::string(what) + ": " + optixGetErrorName(result));
}

enum class Over { triangles, boxes };

template <Over over, bool updates>
class Optix : public adapter::CudaMethod {
public:
    Optix()
    {
        // Of the driver. Until it is loaded no function of OptiX can say what an error means.
        if (const OptixResult result = optixInit(); result != OPTIX_SUCCESS)
            throw std::runtime_error("the driver has no OptiX " +
                                     std::to_string(OPTIX_VERSION / 10000) + "." +
                                     std::to_string(OPTIX_VERSION % 10000 / 100) + " (error " +
                                     std::to_string(static_cast<int>(result)) + ")");
        check(optixDeviceContextCreate(nullptr, nullptr, &context_), "context of OptiX");
    }
    ~Optix() override { optixDeviceContextDestroy(context_); }

    void build(bvhbench_stages& stages) override
    {
        if constexpr (over == Over::boxes) {
            CudaMethod::build(stages);
        } else {  // its boxes are its own
            mark(0);
            make_tree();
            mark(1);
            read(stages, {"build"});
        }
    }

    void refit(bvhbench_stages& stages) override
    {
        mark(0);
        run(OPTIX_BUILD_OPERATION_UPDATE);
        mark(1);
        read(stages, {"refit"});
    }

protected:
    // The size depends on the counts alone.
    void reserve() override
    {
        points_ = reinterpret_cast<CUdeviceptr>(points());
        input_ = {};
        if constexpr (over == Over::triangles) {
            input_.type = OPTIX_BUILD_INPUT_TYPE_TRIANGLES;
            OptixBuildInputTriangleArray& array = input_.triangleArray;
            array.vertexBuffers = &points_;
            array.numVertices = static_cast<unsigned>(point_count());
            array.vertexFormat = OPTIX_VERTEX_FORMAT_FLOAT3;
            array.indexBuffer = reinterpret_cast<CUdeviceptr>(faces());
            array.numIndexTriplets = triangles();
            array.indexFormat = OPTIX_INDICES_FORMAT_UNSIGNED_INT3;
            array.flags = &flags_;
            array.numSbtRecords = 1;
        } else {
            boxes_ = reinterpret_cast<CUdeviceptr>(boxes<OptixAabb>());
            input_.type = OPTIX_BUILD_INPUT_TYPE_CUSTOM_PRIMITIVES;
            OptixBuildInputCustomPrimitiveArray& array = input_.customPrimitiveArray;
            array.aabbBuffers = &boxes_;
            array.numPrimitives = triangles();
            array.flags = &flags_;
            array.numSbtRecords = 1;
        }
        options_.buildFlags =
            OPTIX_BUILD_FLAG_PREFER_FAST_BUILD | (updates ? OPTIX_BUILD_FLAG_ALLOW_UPDATE : 0);
        OptixAccelBufferSizes sizes{};
        options_.operation = OPTIX_BUILD_OPERATION_BUILD;
        check(optixAccelComputeMemoryUsage(context_, &options_, &input_, 1, &sizes),
              "memory of OptiX");
        output_.allocate(sizes.outputSizeInBytes);
        room_.allocate(std::max(sizes.tempSizeInBytes, sizes.tempUpdateSizeInBytes));
    }

    void make_tree() override { run(OPTIX_BUILD_OPERATION_BUILD); }

private:
    void run(OptixBuildOperation operation)
    {
        options_.operation = operation;
        check(optixAccelBuild(context_, nullptr, &options_, &input_, 1,
                              reinterpret_cast<CUdeviceptr>(room_.data()), room_.size(),
                              reinterpret_cast<CUdeviceptr>(output_.data()), output_.size(),
                              &handle_, nullptr, 0),
              "optixAccelBuild");
    }

    OptixDeviceContext context_ = nullptr;
    OptixBuildInput input_{};
    OptixAccelBuildOptions options_{};
    CUdeviceptr points_ = 0, boxes_ = 0;
    unsigned flags_ = OPTIX_GEOMETRY_FLAG_NONE;
    adapter::DeviceArray<unsigned char> output_, room_;
    OptixTraversableHandle handle_ = 0;
};

template <Over over>
bvhbench_method built(const char* name, const char* summary)
{
    bvhbench_method made = adapter::method<Optix<over, false>>(name, summary);
    made.refit = nullptr;  // what may be updated is built otherwise
    return made;
}

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        built<Over::triangles>("optix-triangles",
                               "optixAccelBuild over triangles, prefer fast build; no pairs"),
        built<Over::boxes>("optix-boxes",
                           "optixAccelBuild over boxes, prefer fast build; no pairs"),
        adapter::method<Optix<Over::triangles, true>>(
            "optix-updated",
            "optixAccelBuild over triangles, prefer fast build, allow update; no pairs")};
    return adapter::plugin(host_abi, "OptiX", LIBRARY_VERSION, "NVIDIA's own",
                           adapter::device_name(), methods);
}
