// SPDX-License-Identifier: MIT
//
// The module bvhbench._core: the library behind the classes of python/bvhbench, which check what they are given.
#include <pybind11/stl.h>

#include "device/device.h"
#include "python/right_pairs.h"
#include "python/scene.h"
#include "python/tree.h"

namespace bvhbench::python {
namespace {

/// The exceptions of Python that errors of the library become. They live as long as the interpreter.
struct Exceptions {
    PyObject *error, *bad_input, *unavailable;
};

PyObject* new_exception(py::module_& module, const char* name, PyObject* bases)
{
    PyObject* const made =
        PyErr_NewException((std::string("bvhbench.") + name).c_str(), bases, nullptr);
    module.add_object(name, made);  // which borrows
    return made;
}

void bind_errors(py::module_& module)
{
    static Exceptions of;
    of.error = new_exception(module, "Error", PyExc_RuntimeError);
    const auto bases = py::make_tuple(py::handle(of.error), py::handle(PyExc_ValueError));
    of.bad_input = new_exception(module, "BadInput", bases.ptr());
    of.unavailable = new_exception(module, "Unavailable", of.error);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const oibvh::BadInput& what) {
            PyErr_SetString(of.bad_input, what.what());
        } catch (const oibvh::Unavailable& what) {
            PyErr_SetString(of.unavailable, what.what());
        } catch (const oibvh::Error& what) {
            PyErr_SetString(of.error, what.what());
        }
    });
}

template <class Bound>
std::unique_ptr<Bound> made_on(const std::string& device, const oibvh::Options& options)
{
    return std::make_unique<Bound>(without_gil([&] { return opened(device); }), options);
}

}  // namespace

PYBIND11_MODULE(_core, module)
{
    bind_errors(module);
    module.def("device_names", [] { return without_gil(device_names); });
    module.def("version", &oibvh::version);
    module.def("right_pairs", &right_pairs);

    py::class_<oibvh::Options>(module, "Options")
        .def(py::init<>())
        .def_readwrite("builder", &oibvh::Options::builder)
        .def_readwrite("order", &oibvh::Options::order)
        .def_readwrite("collider", &oibvh::Options::collider)
        .def_readwrite("adjacent_pairs", &oibvh::Options::adjacent_pairs);
    py::class_<Query>(module, "Query")
        .def(py::init<std::string, std::string, Numbers, Numbers, Numbers, double>());
    py::class_<BoundTree>(module, "Tree")
        .def(py::init(&made_on<BoundTree>))
        .def("build", &BoundTree::build)
        .def("refit", &BoundTree::refit)
        .def("update", &BoundTree::update)
        .def("ask", &BoundTree::ask)
        .def("pairs_with", &BoundTree::pairs_with)
        .def("memory", [](const BoundTree& of) { return of.tree().memory(); })
        .def("builder", [](const BoundTree& of) { return of.tree().builder(); })
        .def("collider", [](const BoundTree& of) { return of.tree().collider(); });
    py::class_<BoundScene>(module, "Scene")
        .def(py::init(&made_on<BoundScene>))
        .def("add", &BoundScene::add)
        .def("place", &BoundScene::place)
        .def("move", &BoundScene::move)
        .def("ask", &BoundScene::ask)
        .def("memory", &BoundScene::memory);
}

}  // namespace bvhbench::python
