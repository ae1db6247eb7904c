// The GIL: C++ functions that run without it, Ctrl-C while they run, and protection from use by other threads.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include <pybind11/pybind11.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/practice/lesson.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "arrays.hpp"
#include "gzip.hpp"

namespace calligraphy::python {

/// Types whose objects are immutable in Python; the arguments keep them alive during a call.
template <class Type>
inline constexpr bool is_immutable = std::is_same_v<Type, Character> || std::is_same_v<Type, CharacterSet> ||
                                     std::is_same_v<Type, PenTrace> || std::is_same_v<Type, Recording>;

template <class Argument, class Type = std::remove_cvref_t<Argument>>
using Kept = std::conditional_t<is_immutable<Type>, const Type&, Type>;

/// Runs the function without the GIL. The arguments are copied before the GIL is released, because another thread may
/// assign to their fields and so free, for example, a page's list of characters while the function reads it.
/// py::call_guard would release the GIL too early, before arguments by value are copied.
template <class Result, class... Arguments>
auto released(Result (*function)(Arguments...)) {
  return [function](const std::remove_cvref_t<Arguments>&... given) -> Result {
    const std::tuple<Kept<Arguments>...> kept(given...);
    const pybind11::gil_scoped_release release;
    return std::apply(function, kept);
  };
}

/// Reads a file without the GIL.
template <class Value, class Path>
auto from_file(Value (*read)(const Path&)) {
  return [read](const std::filesystem::path& path) {
    const pybind11::gil_scoped_release release;
    return read(path.string());
  };
}
/// The content of a file, uncompressed if it is compressed by gzip. Requires that the GIL is released.
inline std::string content_of(const std::filesystem::path& path, CutOff cut_off) {
  std::string content = read_file(path, max_text_bytes);
  if (!is_gzip(path)) return content;
  const pybind11::gil_scoped_acquire gil;
  return inflated(content, path.string(), cut_off);
}
/// Reads a file, compressed by gzip or not, without the GIL.
template <class Value, class Path>
auto from_file(Value (*read)(const Path&), Value (*parse)(std::istream&, std::string_view), CutOff cut_off) {
  return [=](const std::filesystem::path& path) {
    const pybind11::gil_scoped_release release;
    if (!is_gzip(path)) return read(path.string());
    std::istringstream text(content_of(path, cut_off));
    return parse(text, path.string());
  };
}

enum class Gzip { never, by_name };

/// Writes a file without the GIL: all of it or nothing.
template <Gzip gzip = Gzip::never, class... Arguments>
auto to_file(void (*write)(std::ostream&, Arguments...)) {
  return [write](const std::filesystem::path& path, const std::remove_cvref_t<Arguments>&... given) {
    const std::tuple<Kept<Arguments>...> kept(given...);
    const pybind11::gil_scoped_release release;
    std::ostringstream out;
    std::apply([&](const auto&... each) { write(out, each...); }, kept);
    std::string content = std::move(out).str();
    if (gzip == Gzip::by_name && is_named_gzip(path)) {
      const pybind11::gil_scoped_acquire gil;
      content = deflated(content);
    }
    write_file(path, content);
  };
}

/// Lets Python handle signals from time to time while C++ runs without the GIL: Ctrl-C then raises KeyboardInterrupt
/// from within the call. Python handles signals only in its main thread; in any other, this has no effect.
class Interrupt {
 public:
  /// Reads the clock, and acquires the GIL every 50 ms; call without the GIL. @throws error_already_set of the handler
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

using Progress = std::optional<std::function<void(double)>>;  ///< called from time to time with the share completed

/// A progress function that also checks for Ctrl-C.
inline std::function<void(double)> interruptible(const Progress& progress) {
  return [interrupt = Interrupt(), progress](double share) mutable {
    interrupt.check();
    if (progress) (*progress)(share);
  };
}

/// Marks that this thread is inside a force law, which may use what its own loop uses.
class InLaw {
 public:
  explicit InLaw(const void* law) noexcept : law_(law), outer_(std::exchange(innermost, this)) {}
  ~InLaw() { innermost = outer_; }
  InLaw(const InLaw&) = delete;
  InLaw& operator=(const InLaw&) = delete;

  static bool here() noexcept { return innermost != nullptr; }
  /// Whether this thread is inside this law, also if the law has called another.
  static bool here(const void* law) noexcept {
    const InLaw* each = innermost;
    while (each != nullptr && each->law_ != law) each = each->outer_;
    return each != nullptr;
  }

 private:
  static inline thread_local const InLaw* innermost = nullptr;  ///< law that this thread is inside

  const void* law_;
  const InLaw* outer_;
};

/// Stops loops that were destroyed inside their own force law, where no thread can wait for itself. Requires the GIL.
void stop_orphans();

/// During its lifetime the device and the renderer or lesson, either of which may be null, belong to a loop, to one tick
/// of a Servo, or to one call that lets other threads run. idle() refuses any other use, which would be a data race.
/// Requires the GIL.
class AtWork {
 public:
  enum class User { loop, tick, call };
  struct Owner {
    User user;
    const void* law = nullptr;  ///< of a loop or tick, as for InLaw; null: it has none in Python
  };

  /// @throws Error when one of them is already in use. A force law may call with what its own loop owns, but start no
  /// other loop on it, which would run at the same time.
  explicit AtWork(Owner owner, const HapticDevice* device, const void* other = nullptr, const char* what = "renderer") {
    const bool from_law = owner.user != User::loop;
    refuse(device, "device", from_law);
    refuse(other, what, from_law);
    // What the calling force law's loop already owns remains the loop's.
    device_ = device != nullptr && busy.emplace(device, owner).second ? device : nullptr;
    other_ = other != nullptr && busy.emplace(other, owner).second ? other : nullptr;
  }
  ~AtWork() {
    busy.erase(device_);
    busy.erase(other_);
  }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

  /// @throws Error when it is in use, except, if `from_law`, by the loop or tick whose force law calls this
  static void refuse(const void* thing, const char* what, bool from_law = true) {
    auto found = busy.empty() ? busy.end() : busy.find(thing);
    if (found != busy.end() && !InLaw::here()) {
      stop_orphans();
      found = busy.find(thing);
    }
    if (found == busy.end()) return;
    const auto [user, law] = found->second;
    if (from_law && law != nullptr && InLaw::here(law)) return;
    throw Error(std::string("the ") + what +
                (user == User::loop   ? " is in use by a running loop: use it from the force law of that loop, or stop "
                                        "that loop first"
                 : user == User::tick ? " is in use by a tick of a Servo: use it from the force law of that Servo, or "
                                        "between its ticks"
                                      : " is in use by another thread: use one per thread, or take turns"));
  }

 private:
  static inline std::map<const void*, Owner> busy;  ///< protected by the GIL

  const HapticDevice* device_;
  const void* other_;
};

/// The same device, renderer or loop's half of a lesson. @throws Error when it is in use by others
template <class Thing>
Thing& idle(Thing& thing) {
  if constexpr (std::is_base_of_v<HapticDevice, std::remove_const_t<Thing>>) {
    AtWork::refuse(static_cast<const HapticDevice*>(&thing), "device");
  } else {
    AtWork::refuse(&thing, std::is_same_v<std::remove_const_t<Thing>, Lesson> ? "lesson" : "renderer");
  }
  return thing;
}

/// A member function of what idle() takes; returns vectors as arrays.
template <class Class, class Result, class... Arguments>
auto when_idle(Result (Class::*function)(Arguments...) const) {
  return
      [function](const Class& self, Arguments... arguments) { return as_python((idle(self).*function)(arguments...)); };
}
template <class Class, class... Arguments>
auto when_idle(void (Class::*function)(Arguments...)) {
  return [function](Class& self, Arguments... arguments) { (idle(self).*function)(arguments...); };
}

/// Call in a C++ thread before it acquires the GIL: keeps Python's state of the thread until the thread ends, because
/// creating it anew takes about 30 us per tick. Do not join such a thread while holding the GIL.
inline void keep_thread_state() {
  struct KeptState {
    KeptState() {
      if (PyGILState_GetThisThreadState() != nullptr) return;  // a Python thread
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
