#include "pen.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/practice/live_session.hpp>
#include <calligraphy/practice/recording.hpp>

#include "advice_teller.hpp"
#include "interrupt.hpp"
#include "lesson_report.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

/// What a key asks of a lesson.
std::vector<LessonCommandKind> commands_of(const std::string& keys) {
  std::vector<LessonCommandKind> commands;
  for (const char key : keys) {
    if (key == 's') commands.push_back(LessonCommandKind::skip);
    if (key == 'u') commands.push_back(LessonCommandKind::undo);
    if (key == 'w') commands.push_back(LessonCommandKind::show);
  }
  return commands;
}

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
  std::string keys;
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
    for (const LessonEvent& event : view.events) {
      const std::string text = event_text(event, view.lesson, page, options_.language);
      if (!text.empty()) spdlog::info("{}", text);
    }
    keys += stop_key_->look();
    return !interrupted();
  };
  options.commands = [&] { return commands_of(std::exchange(keys, {})); };
  LiveResult result = write_with_device(page, *device_, options);
  if (result.dropped > 0) {
    const std::string warning = fmt::format("{} ticks are missing from a recording", result.dropped);
    is_new(warning);
    spdlog::warn("{}", warning);
  }
  statistics_.push_back(result.statistics);
  lessons_.push_back(std::move(result.writing));
  return std::move(result.recording);
}

bool Pen::is_new(const std::string& warning) {
  if (std::find(warnings_.begin(), warnings_.end(), warning) != warnings_.end()) return false;
  warnings_.push_back(warning);
  return true;
}

}  // namespace calligraphy::tools
