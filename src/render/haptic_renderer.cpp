#include <calligraphy/render/haptic_renderer.hpp>

#include <utility>

#include "effective_options.hpp"
#include "force_output.hpp"
#include "guidance.hpp"
#include "paper.hpp"
#include "pen_sensor.hpp"
#include "stroke_sequencer.hpp"

namespace calligraphy {
namespace {

const HapticTick nothing;

void report(const PenState& pen, const WriterState& writer, const GuidanceForce& guidance, const PaperForce& paper,
            const SentForce& sent, HapticTick& tick) noexcept {
  tick.time = pen.time;
  tick.status = pen.status;
  tick.state = writer.state;
  tick.events = writer.events;
  tick.character = writer.character;
  tick.stroke = writer.stroke;
  tick.device_point = pen.device_point;
  tick.pen_tip = pen.tip;
  tick.penetration = pen.penetration;
  if (writer.state != InteractionState::separation || writer.events != TickEvent::none) tick.contact = writer.contact;
  tick.covered = writer.covered;
  tick.hint = hint_in(writer.phase);
  if (sent.is_warm && tick.hint == WritingHint::none) tick.hint = WritingHint::warm_motors;
  tick.to_start = writer.to_start;
  tick.attraction = guidance.attraction;
  tick.wrong_way = guidance.wrong_way;
  tick.friction = paper.friction;
  tick.normal = paper.normal + guidance.normal;
  tick.viscous = sent.viscous;
  tick.assistance = guidance.assistance;
  tick.energy_given = sent.energy_given;
  tick.heat = sent.heat;
  tick.page_force = sent.page;
  tick.force = sent.device;
}

}  // namespace

/// The stages, in the order of a tick.
struct HapticRenderer::Stages {
  Stages(std::vector<PlacedCharacter> page, const MotionMapping& to_page, const Capabilities& capabilities,
         const RendererOptions& options)
      : mapping(to_page),
        effective(effective_options(options, page, mapping, capabilities)),
        guidance(effective, guidance_law(effective, capabilities)),
        sensor(effective.options, mapping, capabilities),
        sequencer(std::move(page), effective.options, capabilities, mapping, effective.traits.lets_go),
        paper(effective.options),
        output(effective.options, capabilities, mapping, effective.law_stiffness,
               effective.has_own_law) {}

  MotionMapping mapping;
  EffectiveOptions effective;
  Guidance guidance;
  PenSensor sensor;
  StrokeSequencer sequencer;
  Paper paper;
  ForceOutput output;
  HapticTick tick;
};

HapticRenderer::HapticRenderer(std::vector<PlacedCharacter> page, const MotionMapping& mapping,
                               const Capabilities& capabilities, const RendererOptions& options)
    : stages_(std::make_unique<Stages>(std::move(page), mapping, capabilities, options)) {}

HapticRenderer::HapticRenderer(HapticRenderer&&) noexcept = default;
HapticRenderer& HapticRenderer::operator=(HapticRenderer&&) noexcept = default;
HapticRenderer::~HapticRenderer() = default;

void HapticRenderer::restart() noexcept {
  stages_->sensor.restart();
  stages_->sequencer.restart();
  stages_->guidance.restart();
  stages_->paper.release();
  stages_->output.restart();
  stages_->tick = {};
}

/// Inlines everything that it calls in this component, except for what happens once per stroke (gnu::noinline): calls
/// of small functions took a fifth of a tick.
[[gnu::flatten]] const HapticTick& HapticRenderer::update(const DeviceState& sample) noexcept {
  if (!stages_) [[unlikely]] return nothing;
  Stages& stages = *stages_;
  ForceOutput& output = stages.output;
  const SentForce& sent = output.last();
  PenState& pen = stages.sensor.update(sample, sent.device);
  const WriterState& writer = stages.sequencer.update(pen);
  const GuidanceForce& guidance = stages.guidance.update(pen, writer, sent.guidance);
  const PaperForce& paper = stages.paper.update(pen, writer, sent.page.z());
  output.update(pen, guidance, paper);
  report(pen, writer, guidance, paper, sent, stages.tick);
  return stages.tick;
}

bool HapticRenderer::skip_stroke() noexcept { return stages_->sequencer.skip(); }
bool HapticRenderer::set_due(int character, int stroke) noexcept {
  return stages_->sequencer.set_due(character, stroke);
}
void HapticRenderer::set_assistance(double factor) noexcept { stages_->guidance.set_assistance(factor); }
const HapticTick& HapticRenderer::last() const noexcept { return stages_->tick; }
const GuidanceTraits& HapticRenderer::law() const noexcept { return stages_->effective.traits; }
const std::exception_ptr& HapticRenderer::law_error() const noexcept { return stages_->guidance.error(); }
const RendererOptions& HapticRenderer::options() const noexcept { return stages_->effective.options; }
const std::vector<std::string>& HapticRenderer::clipped() const noexcept { return stages_->effective.clipped; }
const MotionMapping& HapticRenderer::mapping() const noexcept { return stages_->mapping; }
const std::vector<PlacedCharacter>& HapticRenderer::page() const noexcept { return stages_->sequencer.page(); }
double HapticRenderer::max_force_step() const noexcept {
  return stages_->output.max_step() * stages_->mapping.scale;
}

}  // namespace calligraphy
