// SPDX-License-Identifier: MIT
#include "device/loops.h"

namespace bvhbench {

bool ends_loops_early(const Device& device)
{
    constexpr cl_uint steps = 100'000;
    cl_uint expected = 0;
    for (cl_uint step = 0; step < steps; ++step)
        expected = (expected ^ step) * 1664525u + 1013904223u;

    cl::Program program(device.context, device.sources.flatten("device/loops.cl"));
    program.build(device.cl);
    cl::Kernel kernel(program, "take_steps");
    const cl::CommandQueue queue(device.context, device.cl);
    const cl::Buffer word(device.context, CL_MEM_WRITE_ONLY, sizeof(cl_uint));
    kernel.setArg(0, word);
    kernel.setArg(1, steps);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
    cl_uint found = 0;
    queue.enqueueReadBuffer(word, CL_TRUE, 0, sizeof found, &found);
    return found != expected;
}

}  // namespace bvhbench
