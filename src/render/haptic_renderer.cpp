#include <calligraphy/render/haptic_renderer.hpp>

#include <utility>

namespace calligraphy {

HapticRenderer::HapticRenderer(std::vector<PlacedCharacter> page, const MotionMapping& mapping,
                               const Capabilities& capabilities, const RendererOptions& options)
    : mapping_(mapping),
      effective_(effective_options(options, page, mapping, capabilities)),
      guidance_(effective_, guidance_law(effective_, capabilities)),
      sensor_(effective_.options, mapping, capabilities),
      sequencer_(std::move(page), effective_.options, capabilities, mapping, effective_.traits.lets_go),
      paper_(effective_.options),
      output_(effective_.options, capabilities, mapping, effective_.law_stiffness) {}

void HapticRenderer::restart() noexcept {
  sensor_.restart();
  sequencer_.restart();
  guidance_.restart();
  paper_.release();
  output_.restart();
  tick_ = {};
}

/// Compiled into one piece with all that it calls in this component, except for what happens once in a stroke
/// (gnu::noinline): calls of small functions took a fifth of a tick.
[[gnu::flatten]] const HapticTick& HapticRenderer::update(const DeviceState& sample) noexcept {
  PenState& pen = sensor_.update(sample, output_.last().device);
  const WriterState& writer = sequencer_.update(pen);
  const GuidanceForce& guidance = guidance_.update(pen, writer, output_.last().guidance);
  const PaperForce& paper = paper_.update(pen, writer, output_.last().page.z());
  const SentForce& sent = output_.update(pen, guidance, paper);
  report(pen, writer, guidance, paper, sent);
  return tick_;
}

void HapticRenderer::report(const PenState& pen, const WriterState& writer, const GuidanceForce& guidance,
                            const PaperForce& paper, const SentForce& sent) noexcept {
  tick_.time = pen.time;
  tick_.status = pen.status;
  tick_.state = writer.state;
  tick_.events = writer.events;
  tick_.character = writer.character;
  tick_.stroke = writer.stroke;
  tick_.device_point = pen.device_point;
  tick_.pen_tip = pen.tip;
  tick_.penetration = pen.penetration;
  if (writer.phase != WritingPhase::lifted || writer.events != TickEvent::none) tick_.contact = writer.contact;
  tick_.covered = writer.covered;
  tick_.hint = hint_in(writer.phase);
  if (sent.is_warm && tick_.hint == WritingHint::none) tick_.hint = WritingHint::warm_motors;
  tick_.to_start = writer.to_start;
  tick_.attraction = guidance.attraction;
  tick_.wrong_way = guidance.wrong_way;
  tick_.friction = paper.friction;
  tick_.normal = paper.normal + guidance.normal;
  tick_.viscous = sent.viscous;
  tick_.assistance = guidance.assistance;
  tick_.energy_given = sent.energy_given;
  tick_.heat = sent.heat;
  tick_.page_force = sent.page;
  tick_.force = sent.device;
}

}  // namespace calligraphy
