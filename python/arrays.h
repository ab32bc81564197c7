// SPDX-License-Identifier: MIT
//
// NumPy's arrays as the library takes and gives them. The Python side makes them contiguous and of these types (arrays.py).
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <span>

namespace bvhbench::python {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style>;
using Numbers = py::array_t<std::uint32_t, py::array::c_style>;

/// Returns the values of an array, as many a row as `T` has, without a copy. Asks for no size of an item: pybind11 2.10 takes it from
/// where NumPy 2 no longer has it.
template <class T, class Item>
std::span<const T> values_of(const py::array_t<Item, py::array::c_style>& array)
{
    static_assert(sizeof(T) % sizeof(Item) == 0);
    return {reinterpret_cast<const T*>(array.data()),
            static_cast<std::size_t>(array.size()) * sizeof(Item) / sizeof(T)};
}

/// Runs `work` without the GIL, so that other threads of Python go on.
template <class Work>
auto without_gil(Work&& work)
{
    const py::gil_scoped_release released;
    return work();
}

}  // namespace bvhbench::python
