// The GIL: functions of C++ that run without it, Ctrl-C meanwhile, and what another thread must not touch.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <pybind11/pybind11.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/practice/pen_trace.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "arrays.hpp"

namespace calligraphy::python {

/// Types whose objects Python cannot change once they are made; the arguments hold them for as long as a call lasts.
template <class Type>
inline constexpr bool is_immutable = std::is_same_v<Type, Character> || std::is_same_v<Type, CharacterSet> ||
                                     std::is_same_v<Type, PenTrace> || std::is_same_v<Type, Recording>;

template <class Argument, class Type = std::remove_cvref_t<Argument>>
using Kept = std::conditional_t<is_immutable<Type>, const Type&, Type>;

/// The function without the GIL. Its arguments are copied before the GIL is given away, as another thread may assign to
/// what they are made of: a page's list of characters would be freed under the function's feet. py::call_guard would
/// come too early: it gives the GIL away before even an argument by value is copied.
template <class Result, class... Arguments>
auto released(Result (*function)(Arguments...)) {
  return [function](const std::remove_cvref_t<Arguments>&... given) -> Result {
    const std::tuple<Kept<Arguments>...> kept(given...);
    const pybind11::gil_scoped_release release;
    return std::apply(function, kept);
  };
}

/// Lets Python see its signals now and then while C++ works without the GIL: Ctrl-C then raises KeyboardInterrupt from
/// within the call. Python handles signals in its main thread alone; in any other one nothing happens.
class Interrupt {
 public:
  /// Costs a look at the clock; the GIL, which is not held, every 50 ms. @throws error_already_set of the handler
  void check() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + interval;
    const pybind11::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }

 private:
  static constexpr std::chrono::milliseconds interval{50};
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
};

using Progress = std::optional<std::function<void(double)>>;  ///< called now and then with the share that is done

/// A progress function that also looks for Ctrl-C.
inline std::function<void(double)> interruptible(const Progress& progress) {
  return [interrupt = Interrupt(), progress](double share) mutable {
    interrupt.check();
    if (progress) (*progress)(share);
  };
}

/// Within a force law, which runs in the loop's own thread, everything that loops use may be used.
class InLaw {
 public:
  explicit InLaw(const void* law) noexcept : law_(law), outer_(std::exchange(innermost, this)) {}
  ~InLaw() { innermost = outer_; }
  InLaw(const InLaw&) = delete;
  InLaw& operator=(const InLaw&) = delete;

  static bool here() noexcept { return innermost != nullptr; }
  /// Within this one, also where it has called another.
  static bool here(const void* law) noexcept {
    const InLaw* each = innermost;
    while (each != nullptr && each->law_ != law) each = each->outer_;
    return each != nullptr;
  }

 private:
  static inline thread_local const InLaw* innermost = nullptr;  ///< law that this thread is within

  const void* law_;
  const InLaw* outer_;
};

/// While it lives the device and the renderer, either of which may be none, belong to a loop or to one call that has
/// given the GIL away. Whoever else asks is refused by idle(), where C++ would race. Under the GIL.
class AtWork {
 public:
  enum class User { loop, call };

  /// @throws Error when one of them is in use already
  explicit AtWork(User user, const HapticDevice* device, const HapticRenderer* renderer = nullptr) {
    refuse(device, "device");
    refuse(renderer, "renderer");
    // What the loop of the calling force law has already stays the loop's.
    device_ = device != nullptr && busy.emplace(device, user).second ? device : nullptr;
    renderer_ = renderer != nullptr && busy.emplace(renderer, user).second ? renderer : nullptr;
  }
  ~AtWork() {
    busy.erase(device_);
    busy.erase(renderer_);
  }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

  /// @throws Error when it is in use, and not by the loop whose force law calls
  static void refuse(const void* thing, const char* what) {
    const auto found = busy.empty() ? busy.end() : busy.find(thing);
    if (found == busy.end() || (found->second == User::loop && InLaw::here())) return;
    throw Error(std::string("the ") + what +
                (found->second == User::loop
                     ? " is at work in a running loop: use it from the force law, or stop the loop"
                     : " is in use by another thread: use one per thread, or take turns"));
  }

 private:
  static inline std::map<const void*, User> busy;  ///< under the GIL

  const HapticDevice* device_;
  const HapticRenderer* renderer_;
};

/// The same device or renderer. @throws Error when it is in use by others
template <class Thing>
Thing& idle(Thing& thing) {
  if constexpr (std::is_base_of_v<HapticDevice, std::remove_const_t<Thing>>) {
    AtWork::refuse(static_cast<const HapticDevice*>(&thing), "device");
  } else {
    AtWork::refuse(&thing, "renderer");
  }
  return thing;
}

/// A member function of a device or renderer that is not in use by others, vectors as arrays.
template <class Class, class Result, class... Arguments>
auto when_idle(Result (Class::*function)(Arguments...) const) {
  return
      [function](const Class& self, Arguments... arguments) { return as_python((idle(self).*function)(arguments...)); };
}
template <class Class, class... Arguments>
auto when_idle(void (Class::*function)(Arguments...)) {
  return [function](Class& self, Arguments... arguments) { (idle(self).*function)(arguments...); };
}

/// In a thread of C++, before it takes the GIL: what Python keeps of the thread is kept until the thread ends. Made
/// anew in every tick it costs some 30 us. Whoever joins such a thread must not hold the GIL.
inline void keep_thread_state() {
  struct KeptState {
    KeptState() {
      if (PyGILState_GetThisThreadState() != nullptr) return;  // a thread of Python
      lock = PyGILState_Ensure();
      state = PyEval_SaveThread();
    }
    ~KeptState() {
      if (state == nullptr || Py_IsInitialized() == 0) return;
      PyEval_RestoreThread(state);
      PyGILState_Release(lock);
    }
    PyGILState_STATE lock = PyGILState_UNLOCKED;
    PyThreadState* state = nullptr;
  };
  thread_local const KeptState kept;
}

}  // namespace calligraphy::python
