// Laws of guidance and of force written in Python, as options.
#pragma once

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>

#include <calligraphy/devices/servo.hpp>
#include <calligraphy/render/guidance_law.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "callbacks.hpp"
#include "fields.hpp"

namespace calligraphy::python {

/// An object of which C++ threads may hold the last reference: its deleter acquires the GIL.
inline std::shared_ptr<const py::object> kept(const py::object& object) {
  return {new py::object(object), [](const py::object* made) {
            const py::gil_scoped_acquire gil;
            delete made;
          }};
}

/// Whether there is such an attribute. Raises anything but AttributeError, which py::hasattr() would hide.
inline bool has_attribute(const py::object& object, const char* name) {
  try {
    object.attr(name).operator py::object();
    return true;
  } catch (const py::error_already_set& raised) {
    if (!raised.matches(PyExc_AttributeError)) throw;
    return false;
  }
}

/// The name of a law in recordings.
inline std::string name_of_law(const py::object& law) {
  if (has_attribute(law, "name")) return converted(Given<std::string>(law.attr("name")), "name");
  const py::object named = py::hasattr(law, "__name__") ? law : py::type::of(law);
  return py::str(named.attr("__name__"));
}

/// @throws error_already_set, to which write_with_device() can attach its result
[[noreturn]] inline void refuse_result(const char* expected, const py::object& given) {
  const py::object brief = py::module_::import("calligraphy._struct").attr("brief")(given);
  const py::object type = py::module_::import("calligraphy._calligraphy").attr("InvalidValue");
  InStep::raise(type(formatted("force: expected {}, got {}", expected, brief)));
}

/// An object with a method force(), or a function. Acquires the GIL on every call.
class PythonGuidance final : public GuidanceLaw {
 public:
  /// Makes an object of a class for each renderer; anything else is called as it is.
  struct Factory {
    std::shared_ptr<const py::object> law;
    std::unique_ptr<GuidanceLaw> operator()(const GuidanceSetup&) const {
      const py::gil_scoped_acquire gil;
      const bool makes = PyType_Check(without_partial(*law).ptr()) != 0;
      return std::unique_ptr<GuidanceLaw>(new PythonGuidance(makes ? (*law)() : *law));
    }
  };
  /// What a factory was made from; null if the law is in C++. Requires the GIL.
  static py::object given(const GuidanceFactory& factory) {
    const auto* const own = factory.target<Factory>();
    return own != nullptr ? *own->law : py::object();
  }
  /// Whether an object can be a law.
  static bool accepts(const py::object& given) {
    const py::object object = without_partial(given);
    if (py::hasattr(object, "force")) return PyCallable_Check(object.attr("force").ptr()) != 0;
    return PyType_Check(object.ptr()) == 0 && PyCallable_Check(object.ptr()) != 0;
  }

  ~PythonGuidance() override {
    const py::gil_scoped_acquire gil;
    law_ = force_ = begin_ = {};
  }
  PythonGuidance(const PythonGuidance&) = delete;
  PythonGuidance& operator=(const PythonGuidance&) = delete;

  /// @throws TypeError naming the attribute
  GuidanceTraits traits() const override {
    const py::gil_scoped_acquire gil;
    GuidanceTraits traits;
    traits.name = name_of_law(law_);
    each_field<GuidanceTraits>([&]<class Member>(const Field<GuidanceTraits, Member>& field) {
      if (!has_attribute(law_, field.name)) return;
      traits.*field.member = converted(Given<Member>(law_.attr(field.name)), field.name);
    });
    return traits;
  }

  void begin(const ActiveStroke& stroke) override {
    if (!begin_) return;
    const py::gil_scoped_acquire gil;
    begin_(stroke);
  }

  /// @throws error_already_set what the law raised; InvalidValue if it returned no force
  GuidanceTerms force(const GuidanceInput& input) override {
    const py::gil_scoped_acquire gil;
    const py::object result = force_(input);
    try {
      const GuidanceTerms terms = py::isinstance<GuidanceTerms>(result)
                                      ? result.cast<GuidanceTerms>()
                                      : GuidanceTerms{point(result, "force"), guidance_damper(input, input.share)};
      if (terms.spring.allFinite() && terms.damper.allFinite() && std::isfinite(terms.normal)) return terms;
    } catch (const ValueError&) {  // the message below says more
    }
    refuse_result("(2,) finite numbers or GuidanceTerms", result);
  }

 private:
  explicit PythonGuidance(py::object law)
      : law_(std::move(law)), force_(py::getattr(law_, "force", law_)), begin_(py::getattr(law_, "begin", py::none())) {
    if (begin_.is_none()) begin_ = {};
  }

  /// The callee of a functools.partial, such as a class whose constructor takes arguments.
  static py::object without_partial(const py::object& given) {
    return py::isinstance(given, py::module_::import("functools").attr("partial")) ? given.attr("func") : given;
  }

  py::object law_, force_, begin_;
};

/// Raises what a law raised, with its traceback, or why it gave no force: anew, because pybind11 gives each exception
/// back to Python only once.
[[noreturn]] inline void raise_again(const std::exception_ptr& raised) {
  try {
    std::rethrow_exception(raised);
  } catch (const py::error_already_set& error) {
    const py::gil_scoped_acquire gil;
    InStep::raise(InStep::with_traceback(error));
  }
}

/// Calls HapticRenderer::update(). @throws as raise_again()
inline const HapticTick& updated(HapticRenderer& renderer, const DeviceState& state) {
  const HapticTick& tick = renderer.update(state);
  if (tick.status == TickStatus::bad_law && renderer.law_error()) raise_again(renderer.law_error());
  return tick;
}

/// The law of a session, a function in Python. Unlike a PythonLaw it passes exceptions on: they end the session.
class SessionLaw {
 public:
  /// Requires the GIL.
  explicit SessionLaw(const py::object& law) : law_(kept(law)) {}

  Eigen::Vector3d operator()(const DeviceState& state) const {
    const py::gil_scoped_acquire gil;
    const py::object result = (*law_)(state);
    try {
      const Eigen::Vector3d force = vector(result, "force");
      if (force.allFinite()) return force;
    } catch (const ValueError&) {  // the message below says more
    }
    refuse_result("(3,) finite numbers", result);
  }

  /// The function. Requires the GIL.
  static py::object given(const ForceLaw& law) {
    const auto* const own = law.target<SessionLaw>();
    return own != nullptr ? *own->law_ : py::none();
  }

 private:
  std::shared_ptr<const py::object> law_;
};

}  // namespace calligraphy::python

/// The law of a session: a function, or None.
template <>
class pybind11::detail::type_caster<calligraphy::ForceLaw> {
 public:
  PYBIND11_TYPE_CASTER(calligraphy::ForceLaw,
                       const_name("collections.abc.Callable[[") + make_caster<calligraphy::DeviceState>::name +
                           const_name("], numpy.typing.ArrayLike] | None"));

  bool load(handle given, bool) {
    if (given.is_none()) return true;
    if (PyCallable_Check(given.ptr()) == 0) return false;
    const auto law = reinterpret_borrow<object>(given);
    value = calligraphy::python::SessionLaw(law);
    value.name = calligraphy::python::name_of_law(law);
    return true;
  }
  static handle cast(const calligraphy::ForceLaw& law, return_value_policy, handle) {
    return calligraphy::python::SessionLaw::given(law).release();
  }
};

/// A guidance law by its name, or one in Python.
template <>
class pybind11::detail::type_caster<calligraphy::GuidanceFactory> {
 public:
  PYBIND11_TYPE_CASTER(calligraphy::GuidanceFactory, const_name("typing.Any"));

  /// @throws ValueError listing the names when given another one
  bool load(handle given, bool) {
    if (!isinstance<str>(given)) {
      const auto object = reinterpret_borrow<pybind11::object>(given);
      if (!calligraphy::python::PythonGuidance::accepts(object)) return false;
      value = calligraphy::python::PythonGuidance::Factory{calligraphy::python::kept(object)};
      return true;
    }
    const auto wanted = given.cast<std::string>();
    for (const auto& [law, make] : laws) {
      if (wanted != law) continue;
      value = make;
      return true;
    }
    throw calligraphy::ValueError("expected one of linear, saturating, wang2006, got " +
                                  repr(given).cast<std::string>());
  }
  static handle cast(const calligraphy::GuidanceFactory& law, return_value_policy, handle) {
    for (const auto& [called, make] : laws) {
      if (law.is(make)) return str(called).release();
    }
    return calligraphy::python::PythonGuidance::given(law).release();
  }

 private:
  static constexpr std::pair<const char*, calligraphy::GuidanceFactory::Make*> laws[] = {
      {"linear", calligraphy::linear_guidance},
      {"saturating", calligraphy::saturating_guidance},
      {"wang2006", calligraphy::printed_guidance}};
};
