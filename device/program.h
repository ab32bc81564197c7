// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "device/buffer.h"
#include "device/device.h"

namespace bvhbench {

/// Thrown if a kernel does not compile. The message contains the driver's build log.
class BuildFailure : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A number that a kernel needs at compile time. The host passes its own constant, so that it is defined only once.
struct Define {
    std::string_view name;
    unsigned value;
};

/// Where the compiler may optimise a kernel.
enum class Optimise {
    freely,
    /// Not on CPUs: PoCL 3.1 miscompiles some kernels with many inlined functions unless optimisation is off, and oclgrind
    /// cannot read the annotations that inlining leaves.
    on_gpus,
};

/// The compiled programs of one device, cached by files and options: a file is read once. Not thread-safe.
class Programs {
public:
    /// `dialect` is the value of -cl-std=. Every kernel must compile as CL1.2 and as CL3.0.
    explicit Programs(const Device& device, std::string dialect = "CL1.2");

    const Device& device() const { return device_; }

    /// Returns kernel `name` of file `path`, compiled with `defines`. Every call returns a new kernel object, so that owners do
    /// not share arguments. Throws BuildFailure, or Unavailable if the device does not support the kernel's group size or
    /// local memory.
    cl::Kernel kernel(std::string_view path, const char* name,
                      std::initializer_list<Define> defines = {},
                      Optimise optimise = Optimise::freely);
    cl::Kernel kernel(std::string_view path, const char* name, std::span<const Define> defines,
                      Optimise optimise = Optimise::freely);

    /// Returns the kernel compiled from `header` followed by the file `path`, which does not include a header of this kind
    /// itself. So one file serves several headers.
    cl::Kernel kernel(std::string_view header, std::string_view path, const char* name,
                      std::span<const Define> defines, Optimise optimise = Optimise::freely);

    /// Returns the host time spent compiling so far, in nanoseconds. It is reported once per run and never part of a sample.
    std::int64_t compile_ns() const { return compile_ns_; }

private:
    cl::Program build(std::string_view path, const std::string& text, const std::string& options);
    cl::Program built(const std::string& text, const std::string& options) const;

    const Device& device_;
    std::string dialect_;
    bool declares_builtins_;                       ///< whether device/builtins.clh precedes texts
    std::map<std::string, cl::Program> programs_;  ///< by options and files
    std::int64_t compile_ns_ = 0;
};

}  // namespace bvhbench
