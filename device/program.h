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

/// A kernel that would not build, with the log the driver gave.
class BuildFailure : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A number the kernel needs at compile time. The host passes its own constant, so there is one.
struct Define {
    std::string_view name;
    unsigned value;
};

/// How far the compiler may go.
enum class Optimise {
    freely,
    on_gpus,  ///< not on a CPU: of some kernels of many helpers PoCL 3.1 makes wrong code, and not so without, and
              ///< oclgrind cannot read the marks that inlining leaves
};

/// The programs of one device, each compiled once however many builders ask for it.
///
/// Cached by text, options and device (one object serves one device). Not for several threads at once.
class Programs {
public:
    /// `dialect` is what -cl-std= names; every kernel must compile as CL1.2 and as CL3.0.
    explicit Programs(const Device& device, std::string dialect = "CL1.2");

    const Device& device() const { return device_; }

    /// The kernel `name` of the file `path`, built with `defines`. A new kernel object at every call, so that
    /// arguments set by one owner never reach another. Throws BuildFailure, and Unavailable where the device cannot
    /// give a group what the kernel says it needs.
    cl::Kernel kernel(std::string_view path, const char* name,
                      std::initializer_list<Define> defines = {},
                      Optimise optimise = Optimise::freely);
    cl::Kernel kernel(std::string_view path, const char* name, std::span<const Define> defines,
                      Optimise optimise = Optimise::freely);

    /// The same of a file that is compiled behind a header it does not name, so that one text serves several.
    cl::Kernel kernel(std::string_view header, std::string_view path, const char* name,
                      std::span<const Define> defines, Optimise optimise = Optimise::freely);

    /// Host time spent compiling so far, in nanoseconds: reported once a run, never part of a sample.
    std::int64_t compile_ns() const { return compile_ns_; }

private:
    cl::Kernel compiled(const std::string& text, std::string_view path, const char* name,
                        std::span<const Define> defines, Optimise optimise);
    cl::Program build(std::string_view path, const std::string& text, const std::string& options);
    cl::Program built(const std::string& text, const std::string& options) const;

    const Device& device_;
    std::string dialect_;
    bool declares_builtins_;                       ///< whether texts go behind device/builtins.clh
    std::map<std::string, cl::Program> programs_;  ///< by options and text
    std::int64_t compile_ns_ = 0;
};

}  // namespace bvhbench
