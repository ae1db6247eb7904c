#include "pen.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/practice/hint_text.hpp>
#include <calligraphy/practice/live_session.hpp>
#include <calligraphy/practice/recording.hpp>

#include "advice_teller.hpp"
#include "interrupt.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

/// Tells a person each hint once it has lasted: a moving pen passes many that it does not need to hear of.
class HintTeller {
 public:
  explicit HintTeller(const Language& language) : language_(language) {}

  void look(const LiveView& view) {
    const double now = view.newest.time;
    if (view.hint != hint_) {
      hint_ = view.hint;
      since_ = now;
      told_ = false;
    }
    if (told_ || hint_ == WritingHint::none || now - since_ < long_enough) return;
    spdlog::info("{}", hint_text(hint_, view.to_start, language_));
    told_ = true;
  }

 private:
  static constexpr double long_enough = 0.3;  ///< [s]

  Language language_;
  WritingHint hint_ = WritingHint::none;
  double since_ = 0.0;  ///< [s]
  bool told_ = false;
};

}  // namespace

Pen::Pen(const PenOptions& options) : options_(options) {
  switch (options.device.kind) {
    case DeviceKind::simulated:
      capabilities_ = chosen_device(options.device.which);
      break;
    case DeviceKind::phantom:
    case DeviceKind::openhaptics:
      device_ = open_device(options.device);
      capabilities_ = device_->capabilities();
      break;
  }
  capabilities_ = with_peak_force(capabilities_, options.peak_force);
  interrupt_.emplace();
  if (is_person()) stop_key_.emplace();
}

Recording Pen::write(const PracticePage& page, const SessionOptions& session) {
  if (is_person()) return live(page, session);
  SessionOptions until_ctrl_c = session;
  until_ctrl_c.progress = [this, &session](double share) {
    interrupt_->check();
    if (session.progress) session.progress(share);
  };
  return write_page(page, until_ctrl_c);
}

Recording Pen::live(const PracticePage& page, const SessionOptions& session) {
  DeviceFault told = DeviceFault::none;
  bool told_behind = false;
  HintTeller hints(options_.language);
  AdviceTeller advice;
  LiveOptions options;
  options.mode = session.mode;
  options.renderer = session.renderer;
  options.mapping = session.mapping;
  options.peak_force = options_.peak_force;
  options.timeout = options_.timeout;
  options.keep = session.keep;
  options.watch = [&](const LiveView& view) {
    if (session.progress) session.progress(view.progress);
    if (view.servo.fault != told && view.servo.fault != DeviceFault::none) {
      spdlog::warn("force ramped down to zero: {}", to_string(view.servo.fault));
    }
    told = view.servo.fault;
    for (const std::string& warning : view.warnings) {
      if (is_new(warning)) spdlog::warn("{}", warning);
    }
    if (advice.look(view.advice)) is_new(view.advice);
    if (view.behind > 0.0 && !std::exchange(told_behind, true)) {
      const std::string distance = fmt::format("{:.0f}", 1e3 * view.behind);
      spdlog::info("{}", options_.language.text("write.behind", {{"distance", distance}}));
    }
    hints.look(view);
    stop_key_->look();
    return !interrupted();
  };
  LiveResult result = write_with_device(page, *device_, options);
  if (result.dropped > 0) {
    const std::string warning = fmt::format("{} ticks are missing from a recording", result.dropped);
    is_new(warning);
    spdlog::warn("{}", warning);
  }
  statistics_.push_back(result.statistics);
  return std::move(result.recording);
}

bool Pen::is_new(const std::string& warning) {
  if (std::find(warnings_.begin(), warnings_.end(), warning) != warnings_.end()) return false;
  warnings_.push_back(warning);
  return true;
}

}  // namespace calligraphy::tools
