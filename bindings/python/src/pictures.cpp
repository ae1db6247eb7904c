// Pictures of pages, and what notebooks show, which calligraphy/_display.py draws.
#include <calligraphy/pictures/picture.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// Of any type to a type checker.
struct Table : py::object {
  explicit Table(py::object value) : py::object(std::move(value)) {}
};

/// A method of a class that calls a function of calligraphy/_display.py.
template <class Result>
void add_display(const py::module_& module, const char* kind, const char* name, const char* function,
                 const char* documentation) {
  const py::object type = module.attr(kind);
  type.attr(name) = py::cpp_function(
      [function](const py::object& self) {
        return Result(py::module_::import("calligraphy._display").attr(function)(self));
      },
      py::name(name), py::is_method(type), documentation);
}

}  // namespace
}  // namespace calligraphy::python

template <>
struct pybind11::detail::handle_type_name<calligraphy::python::Table> {
  static constexpr auto name = const_name("typing.Any");
};

namespace calligraphy::python {

void add_pictures(py::module_& module) {
  add_types<StrokeStyle>(module);
  module.def("page_picture", released(&page_picture), "page"_a, "recording"_a, "active"_a = 0, "title"_a = "",
             "style"_a = StrokeStyle::ink);
  const char* const shown = "What a notebook shows, as SVG.";
  add_display<py::str>(module, "Character", "_repr_svg_", "character", shown);
  add_display<py::str>(module, "PracticePage", "_repr_svg_", "page", shown);
  add_display<py::str>(module, "Recording", "_repr_svg_", "recording", shown);
  add_display<Table>(module, "Recording", "to_pandas", "table",
                     "A pandas.DataFrame with a row per tick: time [s]; device_x, device_y, device_z, tip_x, tip_y, "
                     "tip_z [m] and force_x, force_y, force_z [N] in page axes; state (an InteractionState) and status "
                     "(a TickStatus), categories by name; events, the sum of TickEvent's bits; character and stroke, "
                     "indices of the active ones; tick_ns [ns]. Raises ImportError without pandas.");
}

}  // namespace calligraphy::python
