// Real time: the servo loop in its own thread, and a person writing a page on a device.
#include <unistd.h>

#include <calligraphy/practice/live_session.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

bool exiting = false;  ///< protected by the GIL

/// At exit all loops and sessions are stopped; daemon threads must not start new ones.
void refuse_at_exit() {
  if (exiting) throw Error("the program is exiting: no servo loop or session can be started");
}

/// Calls warnings.warn(). @throws the warning, where a filter makes it an exception
void warn(const std::string& text) {
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

/// A ServoLoop that keeps device and law alive, stops when the program exits, and releases the GIL while it waits,
/// because its law may need the GIL to return.
class Loop {
 public:
  // A vendor's clock may end its thread only when the device is closed, with the GIL held.
  Loop(HapticDevice& device, const std::variant<HapticRenderer*, Law>& law, const ServoLoopOptions& options)
      : device_(py::cast(&device)) {
    ForceLaw force;
    if (const auto* const renderer = std::get_if<HapticRenderer*>(&law)) {
      if (*renderer == nullptr) throw py::type_error("law: expected a HapticRenderer or a callable, got None");
      renderer_ = *renderer;
      renderer_of_python_ = py::cast(renderer_);
      if (PythonGuidance::given(renderer_->options().guidance.force)) {
        python_law_ = PythonLaw::make(py::cpp_function(
            [asked = *renderer](const DeviceState& state) { return array_of(updated(*asked, state).force); }));
      } else {
        force = **renderer;
      }
    } else {
      python_law_ = PythonLaw::make(std::get<Law>(law));
    }
    if (python_law_) force = PythonLaw::force_law(python_law_, device.clock() == nullptr);
    if (renderer_ != nullptr) force.rate = renderer_->options().servo_rate;
    loop_ = std::make_unique<ServoLoop>(device, std::move(force), options);
  }
  ~Loop() {
    stop();
    if (!loop_->running()) return;
    // A thread can join neither itself nor threads left behind by fork(): the force is released, the rest is deferred.
    running.erase(this);
    orphans.push_back(
        {std::move(device_), std::move(renderer_of_python_), std::move(loop_), std::move(at_work_), process_});
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  std::vector<std::string> start() {
    refuse_at_exit();
    if (changing_ || loop_->running())
      throw ValueError("the servo loop is already running: stop it before starting it again");
    PythonDevice::refuse_without_capabilities(device_.cast<HapticDevice&>());
    at_work_ = std::make_unique<AtWork>(AtWork::Owner{AtWork::User::loop, python_law_.get()},
                                        &device_.cast<HapticDevice&>(), renderer_);
    if (python_law_) python_law_->forget_errors();
    changing_ = true;
    process_ = getpid();
    try {
      const py::gil_scoped_release release;
      warnings_ = loop_->start([this](const std::vector<std::string>& warnings) {
        const py::gil_scoped_acquire gil;
        for (const std::string& warning : warnings) warn(warning);
        const std::string advice = device_.cast<HapticDevice&>().advice();
        if (!advice.empty()) warn(advice);
      });
    } catch (...) {
      changing_ = false;
      at_work_.reset();
      throw;
    }
    changing_ = false;
    running.insert(this);
    return warnings_;
  }

  void stop() {
    if (changing_ || !loop_->running() || is_of_a_parent()) return;
    if (python_law_ && InLaw::here(python_law_.get())) return loop_->stop();
    changing_ = true;
    {
      const py::gil_scoped_release release;
      loop_->stop();
    }
    changing_ = false;
    at_work_.reset();
    running.erase(this);
  }

  static void stop_all() {
    const std::set<Loop*> all = running;
    for (Loop* const loop : all) loop->stop();
    stop_orphans();
  }

  static void stop_orphans() {
    for (std::size_t i = orphans.size(); i-- > 0;) {
      if (orphans[i].process != getpid()) continue;
      const Orphan orphan = std::move(orphans[i]);
      orphans.erase(orphans.begin() + static_cast<std::ptrdiff_t>(i));
      const py::gil_scoped_release release;
      orphan.loop->stop();
    }
  }

  bool is_running() const { return loop_->running(); }
  ServoStatus status() const { return loop_->status(); }
  py::dict statistics() const { return as_dict(loop_->statistics()); }
  const std::vector<std::string>& warnings() const { return warnings_; }
  py::object error() const { return python_law_ ? python_law_->error : py::none(); }
  std::size_t errors() const { return python_law_ ? python_law_->errors : 0; }

 private:
  bool is_of_a_parent() const { return process_ != 0 && process_ != getpid(); }

  /// Remains of loops that were destroyed inside their own law.
  struct Orphan {
    py::object device, renderer;
    std::unique_ptr<ServoLoop> loop;
    std::unique_ptr<AtWork> at_work;
    pid_t process;
  };

  // Protected by the GIL, as is everything outside the loop. Loops of a parent process are never released.
  static std::set<Loop*> running;
  static std::vector<Orphan>& orphans;

  py::object device_, renderer_of_python_;  ///< kept alive
  const HapticRenderer* renderer_ = nullptr;
  std::shared_ptr<PythonLaw> python_law_;  ///< null if the law is a renderer, unless that calls a law in Python
  std::unique_ptr<ServoLoop> loop_;
  std::unique_ptr<AtWork> at_work_;
  std::vector<std::string> warnings_;
  pid_t process_ = 0;      ///< process that started the loop
  bool changing_ = false;  ///< a thread is in start() or stop()
};

std::set<Loop*> Loop::running;
std::vector<Loop::Orphan>& Loop::orphans = *new std::vector<Orphan>;

// Sessions in daemon threads end with the program; protected by the GIL.
int live_sessions = 0;
pid_t process_of_sessions = 0;

struct LiveSession {
  LiveSession() {
    refuse_at_exit();
    if (process_of_sessions != getpid()) live_sessions = 0;  // they were those of a parent process
    process_of_sessions = getpid();
    ++live_sessions;
  }
  ~LiveSession() { --live_sessions; }
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;
};

void end_all() {
  exiting = true;
  Loop::stop_all();
  while (live_sessions > 0 && process_of_sessions == getpid()) {
    const py::gil_scoped_release release;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

using Watch = std::optional<py::typing::Callable<py::object(const LiveView&)>>;

LiveResult write_live(const PracticePage& page, HapticDevice& device, LiveOptions options, const Watch& watch,
                      std::optional<std::filesystem::path> path) {
  PythonDevice::refuse_without_capabilities(device);
  const AtWork at_work({AtWork::User::loop}, &device);
  const LiveSession counted;
  std::exception_ptr raised;
  bool is_first = true;
  std::string advice;
  Store store(std::move(path));
  // What is thrown ends the session by `watch`, so that there is a result. Requires the GIL.
  const auto storing = [&](const auto& act) {
    try {
      act();
    } catch (const Error&) {
      if (raised) return;
      py::detail::try_translate_exceptions();
      raised = std::make_exception_ptr(py::error_already_set());
    }
  };
  options.keep = [&](const Recording& recording) {
    if (!store) return;
    if (!store.is_open()) return store.take(recording);  // nothing has been written yet, and there is no force
    const py::gil_scoped_acquire gil;
    storing([&] { store.take(recording); });
  };
  options.watch = [&](const LiveView& view) {
    if (raised) return false;
    const py::gil_scoped_acquire gil;
    try {
      if (std::exchange(is_first, false)) {
        for (const std::string& warning : view.warnings) warn(warning);
      }
      if (advice != view.advice) {
        advice = view.advice;
        if (!advice.empty()) warn(advice);
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (exiting) return false;
      if (!watch) return true;
      const py::object answer = (*watch)(view);
      const int goes_on = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
      if (goes_on < 0) throw py::error_already_set();
      return goes_on == 1;
    } catch (const py::error_already_set&) {
      raised = std::current_exception();
      return false;
    }
  };
  const auto write = +[](const PracticePage& on, HapticDevice* const& with, const LiveOptions& chosen) {
    return write_with_device(on, *with, chosen);
  };
  LiveResult result = released(write)(page, &device, options);
  if (!raised) raised = std::exchange(result.error, nullptr);
  if (!raised) storing([&] { store.finish(); });
  if (!raised) return result;
  try {
    std::rethrow_exception(raised);
  } catch (py::error_already_set& error) {
    // Keep what was written until then.
    if (PyObject_SetAttrString(error.value().ptr(), "result", py::cast(std::move(result)).ptr()) != 0) PyErr_Clear();
    throw;
  }
}

}  // namespace

void stop_orphans() { Loop::stop_orphans(); }

void add_live(py::module_& module) {
  py::class_<Loop>(
      module, "ServoLoop",
      "+ The law is a HapticRenderer, which runs without Python, or a callable that maps a DeviceState to a force (3,) "
      "[N], which needs the GIL in every tick (docs/python.md). A `with` block starts and stops the loop.")
      .def(py::init<HapticDevice&, const std::variant<HapticRenderer*, Law>&, const ServoLoopOptions&>(), "device"_a,
           "law"_a, "options"_a = ServoLoopOptions{})
      .def("start", &Loop::start,
           "+ The warnings, and the device's advice, are issued by warnings.warn() before the force.")
      .def("stop", &Loop::stop, "+ From within the law it only begins the ramp-down.")
      .def_property_readonly("running", &Loop::is_running)
      .def_property_readonly("status", &Loop::status)
      .def_property_readonly("statistics", &Loop::statistics, "as Servo.statistics, while the loop runs and afterwards")
      .def_property_readonly("warnings", &Loop::warnings, "what the last start() returned")
      .def_property_readonly(
          "error", &Loop::error,
          "the last exception of a Python law since start(), or None; sys.unraisablehook gets the first")
      .def_property_readonly("errors", &Loop::errors, "number of exceptions of a Python law since start()")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<Loop&>().start();
             return self;
           })
      .def("__exit__", [](Loop& self, const py::args&) { self.stop(); });

  py::class_<LiveView>(module, "LiveView")
      .def_property_readonly(
          "newest",
          [](const LiveView& self) {
            return py::array(dtype_of_struct<RecordedSample>(), py::array::ShapeContainer{}, &self.newest);
          },
          "+ A structured array () of sample_dtype, copied.")
      .def_property_readonly(
          "hint", [](const LiveView& self) { return self.lesson.hint; },
          "why a pen on the paper is not guided (hint_text()): the hint that was given last, until it is out of date")
      .def_property_readonly(
          "to_start",
          [](const LiveView& self) { return array_of(Point(self.lesson.start - self.newest.pen_tip.head<2>())); },
          "from the pen tip to the start of the stroke that is due, (2,) [m, page]")
      .def_property_readonly("servo", [](const LiveView& self) { return self.servo; })
      .def_readonly("warnings", &LiveView::warnings)
      .def_readonly("advice", &LiveView::advice)
      .def_readonly("progress", &LiveView::progress)
      .def_readonly("started", &LiveView::started)
      .def_readonly("behind", &LiveView::behind);
  add_types<LiveOptions>(module);
  py::class_<LiveResult>(module, "LiveResult")
      .def_readonly("recording", &LiveResult::recording)
      .def_property_readonly(
          "statistics", [](const LiveResult& self) { return as_dict(self.statistics); }, "as Servo.statistics")
      .def_readonly("dropped", &LiveResult::dropped)
      .def_readonly("warnings", &LiveResult::warnings);
  module.def("with_peak_force", &with_peak_force, "capabilities"_a, "peak_force"_a);
  module.def("write_with_device", &write_live, "page"_a, "device"_a, "options"_a = LiveOptions{},
             "watch"_a = py::none(), "store"_a = py::none(),
             "+ `watch` is called with a LiveView about 50 times per second. The warnings, and the device's advice "
             "whenever it changes, are issued by warnings.warn() too. Also ends on Ctrl-C, or on an "
             "exception of `watch` or of a law, which has the LiveResult as its attribute `result`; `store` "
             "is as in write_page(); after an exception what was written is in PATH.part.");
  // At exit no force may remain, nor threads that would call into a finalised interpreter.
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_all));
}

}  // namespace calligraphy::python
