// Renders guided writing, once per tick: device sample in, force out (Wang 2006, sec. 4.1, Figs. 14 and 15).
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/guidance_law.hpp>
#include <calligraphy/render/haptic_tick.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// Guides a pen through the characters of a page, one after the other, stroke by stroke in the correct order and
/// direction.
///
/// update() neither allocates, locks, throws nor logs, and its work is bounded. Use one renderer per device.
class HapticRenderer {
 public:
  /// Prepares a page, with nothing written.
  /// @throws ValueError naming the option, the mapping, the character or its placement that is invalid, or the stroke
  /// that would not be begun or finished even if drawn exactly, with tolerances other than a preset
  HapticRenderer(std::vector<PlacedCharacter> page, const MotionMapping& mapping, const Capabilities& capabilities,
                 const RendererOptions& options = {});

  /// After the move, update() of the source gives no force; otherwise the source may only be destroyed or assigned to.
  HapticRenderer(HapticRenderer&&) noexcept;
  /// As the move constructor.
  HapticRenderer& operator=(HapticRenderer&&) noexcept;
  ~HapticRenderer();

  /// Processes one sample. Write `force` of the result to the device.
  const HapticTick& update(const DeviceState& sample) noexcept;

  /// Starts the page again: nothing written, force zero immediately, energy and heat as at the beginning.
  void restart() noexcept;

  /// Skips the stroke that is due as though it had been written, but without an event: neither a recording nor a score
  /// counts it as written, even if what was just written for it is not decided yet or in doubt. After the last stroke
  /// of a character the next character is due, and after that of the last character the page counts as written. A pen
  /// on the paper must be lifted first, as after a stroke that was written. last() shows the skip from the next
  /// update() on. Call this in the thread that calls update(), between two calls; it never allocates. Returns false, and
  /// does nothing, while the pen writes the stroke (InteractionState::writing) and when none is due: the page is
  /// written, or the pen has not left the last stroke of the character yet.
  bool skip_stroke() noexcept;

  /// Makes a stroke due, and those after it, whatever was written of the page: an earlier one, to be written again, or,
  /// of a renderer that takes over from another one, the one that is due there. The number of characters and stroke 0:
  /// the page counts as written. As skip_stroke(), it makes no event, what was not decided yet is forgotten, and a pen
  /// on the paper must be lifted first. Call it as that; it never allocates. Returns false, and does nothing, while the
  /// pen writes a stroke (InteractionState::writing), for another character than the active one while it is on the
  /// paper, and for a stroke that the page does not have.
  bool set_due(int character, int stroke) noexcept;

  /// Sets the factor on the guidance from which the assist policy goes on, from 0 to 1 (GuidanceOptions::assist); it has
  /// no effect without that. Call it as skip_stroke().
  void set_assistance(double factor) noexcept;

  /// Traits of the guidance law; the name also states any scaling down, and the energy budget that it was given.
  const GuidanceTraits& law() const noexcept;
  /// First exception of the guidance law since the restart; null: none. TickStatus::bad_law says when.
  const std::exception_ptr& law_error() const noexcept;

  /// What the last update() returned. Only for the thread that calls update(); for a display, publish it through a
  /// LatestValue.
  const HapticTick& last() const noexcept;
  /// Effective options: with StiffnessCheck::clip, stiffnesses may be lower than requested.
  const RendererOptions& options() const noexcept;
  /// The values that were clipped, one line each, with the reason.
  const std::vector<std::string>& clipped() const noexcept;
  /// The mapping from device axes to page axes, as given to the constructor.
  const MotionMapping& mapping() const noexcept;
  /// The characters to be written, in this order.
  const std::vector<PlacedCharacter>& page() const noexcept;
  /// Maximum change of the force per tick [N], reached by a pen of 1 m/s or more; a budget of energy or heat may cut
  /// the force faster. Infinite when the rate is not limited.
  double max_force_step() const noexcept;

 private:
  struct Stages;

  std::unique_ptr<Stages> stages_;  ///< null: moved from
};

}  // namespace calligraphy
