// Real time: the servo loop in a thread of its own, and a person who writes a page with a device.
#include <unistd.h>

#include <calligraphy/practice/live_session.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

bool program_ends = false;  ///< under the GIL

/// Threads that the program does not wait for would begin again what has been ended for them.
void refuse_at_the_end() {
  if (program_ends) throw Error("the program ends: nothing may begin that moves a hand");
}

/// A ServoLoop that keeps device and law alive, waits without the GIL, which its law may need to end, and stops with
/// the program.
class Loop {
 public:
  Loop(HapticDevice& device, HapticRenderer& renderer, const ServoLoopOptions& options)
      : Loop(
            device, py::cast(&renderer), &renderer, nullptr,
            [&renderer](const DeviceState& state) { return renderer.update(state).force; }, options) {}
  // A clock of a vendor may end its thread when the device is closed, with the GIL held.
  Loop(HapticDevice& device, const Law& law, const ServoLoopOptions& options)
      : Loop(device, PythonLaw::make(law), options) {}
  ~Loop() {
    stop();
    if (!loop_->running()) return;
    // This thread cannot join itself, nor threads that fork() left behind: the force is let go, the rest is for later.
    running.erase(this);
    orphans.push_back(
        {std::move(device_), std::move(renderer_of_python_), std::move(loop_), std::move(at_work_), process_});
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  std::vector<std::string> start() {
    refuse_at_the_end();
    if (changing_ || loop_->running())
      throw ValueError("the servo loop runs already: stop it before it is started again");
    if (!InLaw::here()) stop_orphans();
    PythonDevice::refuse_without_capabilities(device_.cast<HapticDevice&>());
    at_work_ = std::make_unique<AtWork>(AtWork::User::loop, &device_.cast<HapticDevice&>(), renderer_);
    if (python_law_) python_law_->forget_errors();
    changing_ = true;
    process_ = getpid();
    try {
      const py::gil_scoped_release release;
      warnings_ = loop_->start();
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

  bool is_running() const { return loop_->running(); }
  ServoStatus status() const { return loop_->status(); }
  py::dict statistics() const { return servo_statistics(loop_->statistics()); }
  const std::vector<std::string>& warnings() const { return warnings_; }
  py::object error() const { return python_law_ ? python_law_->error : py::none(); }
  std::size_t errors() const { return python_law_ ? python_law_->errors : 0; }

 private:
  Loop(HapticDevice& device, const std::shared_ptr<PythonLaw>& law, const ServoLoopOptions& options)
      : Loop(device, py::none(), nullptr, law, PythonLaw::force_law(law, device.clock() == nullptr), options) {}
  Loop(HapticDevice& device, py::object renderer_of_python, HapticRenderer* renderer, std::shared_ptr<PythonLaw> law,
       ForceLaw force, const ServoLoopOptions& options)
      : device_(py::cast(&device)),
        renderer_of_python_(std::move(renderer_of_python)),
        renderer_(renderer),
        python_law_(std::move(law)),
        loop_(std::make_unique<ServoLoop>(device, std::move(force), options)) {}

  bool is_of_a_parent() const { return process_ != 0 && process_ != getpid(); }

  /// What is left of loops that ended within their own law.
  struct Orphan {
    py::object device, renderer;
    std::unique_ptr<ServoLoop> loop;
    std::unique_ptr<AtWork> at_work;
    pid_t process;
  };

  static void stop_orphans() {
    for (std::size_t i = orphans.size(); i-- > 0;) {
      if (orphans[i].process != getpid()) continue;
      const Orphan orphan = std::move(orphans[i]);
      orphans.erase(orphans.begin() + static_cast<std::ptrdiff_t>(i));
      const py::gil_scoped_release release;
      orphan.loop->stop();
    }
  }

  // Under the GIL, as all that is not in the loop. Those of a parent are never let go.
  static std::set<Loop*> running;
  static std::vector<Orphan>& orphans;

  py::object device_, renderer_of_python_;  ///< kept alive
  const HapticRenderer* renderer_;
  std::shared_ptr<PythonLaw> python_law_;  ///< none where the law is a renderer
  std::unique_ptr<ServoLoop> loop_;
  std::unique_ptr<AtWork> at_work_;
  std::vector<std::string> warnings_;
  pid_t process_ = 0;      ///< that started it
  bool changing_ = false;  ///< another thread waits in start() or stop()
};

std::set<Loop*> Loop::running;
std::vector<Loop::Orphan>& Loop::orphans = *new std::vector<Orphan>;

// Sessions of threads that the program does not wait for end with it; under the GIL.
int live_sessions = 0;
pid_t process_of_sessions = 0;

struct LiveSession {
  LiveSession() {
    refuse_at_the_end();
    if (process_of_sessions != getpid()) live_sessions = 0;  // those of a parent
    process_of_sessions = getpid();
    ++live_sessions;
  }
  ~LiveSession() { --live_sessions; }
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;
};

void end_all() {
  program_ends = true;
  Loop::stop_all();
  while (live_sessions > 0 && process_of_sessions == getpid()) {
    const py::gil_scoped_release release;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

using Watch = std::optional<py::typing::Callable<py::object(const LiveView&)>>;

LiveResult write_live(const PracticePage& page, HapticDevice& device, LiveOptions options, const Watch& watch) {
  PythonDevice::refuse_without_capabilities(device);
  const AtWork at_work(AtWork::User::loop, &device);
  const LiveSession counted;
  std::exception_ptr raised;
  options.watch = [&](const LiveView& view) {
    const py::gil_scoped_acquire gil;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (program_ends) return false;
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
  if (!raised) return result;
  try {
    std::rethrow_exception(raised);
  } catch (py::error_already_set& error) {
    // What was written until then is not lost.
    if (PyObject_SetAttrString(error.value().ptr(), "result", py::cast(std::move(result)).ptr()) != 0) PyErr_Clear();
    throw;
  }
}

}  // namespace

void add_live(py::module_& module) {
  py::class_<Loop>(
      module, "ServoLoop",
      "A servo loop in real time, in a thread of its own or on the device's own clock, with a watchdog. The law is a "
      "HapticRenderer, which needs no Python, or a callable from DeviceState to a force (3,) [N], which needs the GIL "
      "in every tick (docs/python.md). A `with` block starts it and stops it at its end, whatever ends it.")
      .def(py::init<HapticDevice&, HapticRenderer&, const ServoLoopOptions&>(), "device"_a, "law"_a,
           "options"_a = ServoLoopOptions{})
      .def(py::init<HapticDevice&, const Law&, const ServoLoopOptions&>(), "device"_a, "law"_a,
           "options"_a = ServoLoopOptions{})
      .def("start", &Loop::start,
           "Begins with no force, which rises. What the system did not permit, each with what to do.")
      .def("stop", &Loop::stop,
           "Lets the force fall to zero, then ends the thread. From within the law it lets the force fall and returns.")
      .def_property_readonly("running", &Loop::is_running, "the loop has been started and not stopped")
      .def_property_readonly("status", &Loop::status, "ServoStatus, while it runs and afterwards")
      .def_property_readonly("statistics", &Loop::statistics, "as of a Servo, while it runs and afterwards")
      .def_property_readonly("warnings", &Loop::warnings, "what the last start() returned")
      .def_property_readonly(
          "error", &Loop::error,
          "the last exception of a law in Python since start(), or None; the first one goes to sys.unraisablehook too")
      .def_property_readonly("errors", &Loop::errors, "how often a law in Python raised since start()")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<Loop&>().start();
             return self;
           })
      .def("__exit__", [](Loop& self, const py::args&) { self.stop(); });

  py::class_<LiveView>(module, "LiveView", "What a display shows, some 50 times a second.")
      .def_property_readonly(
          "newest",
          [](const LiveView& self) {
            const py::object type = py::module_::import("calligraphy._calligraphy").attr("sample_dtype");
            return py::array(type.cast<py::dtype>(), py::array::ShapeContainer{}, &self.newest);
          },
          "the newest tick, all zero before the first one: a structured array () of sample_dtype, copied.")
      .def_property_readonly(
          "servo", [](const LiveView& self) { return self.servo; }, "ServoStatus")
      .def_readonly("progress", &LiveView::progress, "of the page that is written, in [0, 1]")
      .def_readonly("started", &LiveView::started,
                    "the pen has been in front of the paper; before, nothing is felt and nothing recorded");
  add_struct<LiveOptions>(module, "LiveOptions", "A person who writes with a device.", &LiveOptions::mode, "mode: Mode",
                          &LiveOptions::renderer, "renderer: RendererOptions; its servo rate is that of the loop too",
                          &LiveOptions::servo, "servo: ServoLoopOptions; its rate is not read",
                          &LiveOptions::peak_force, "peak_force: at most this, whatever the device can do [N]",
                          &LiveOptions::timeout, "timeout: given up after so long [s]");
  py::class_<LiveResult>(module, "LiveResult", "What came of it.")
      .def_readonly("recording", &LiveResult::recording, "Recording")
      .def_property_readonly(
          "statistics", [](const LiveResult& self) { return servo_statistics(self.statistics); }, "as of a Servo")
      .def_readonly("dropped", &LiveResult::dropped, "ticks that the recording lacks, because `watch` took 2 s or more")
      .def_readonly("warnings", &LiveResult::warnings, "what the servo loop could not have");
  module.def("with_peak_force", &with_peak_force, "capabilities"_a, "peak_force"_a,
             "The device with its forces lowered to a peak [N].");
  module.def("write_with_device", &write_live, "page"_a, "device"_a, "options"_a = LiveOptions{},
             "watch"_a = py::none(),
             "A person writes the page in real time, in C++ without the GIL. Ends when the page is written and the pen "
             "lifted, `watch`, called with a LiveView some 50 times a second, returns False, or time is up; then the "
             "force is zero and the device still open. So do Ctrl-C and what `watch` raises: the exception has the "
             "LiveResult as its attribute `result`.");
  // A program that ends must not leave a force behind, nor threads that ask for a Python that is gone.
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_all));
}

}  // namespace calligraphy::python
