#include "handles.hpp"

#include <array>
#include <atomic>
#include <deque>
#include <limits>
#include <mutex>
#include <new>
#include <utility>

namespace calligraphy::c {
namespace {

// Bits of a handle, from the lowest: kind, index of its slot, and how often the slot has been used.
constexpr int kind_bits = 4, index_bits = 16;
constexpr std::uintptr_t kind_mask = (std::uintptr_t{1} << kind_bits) - 1;
constexpr std::uintptr_t index_mask = (std::uintptr_t{1} << index_bits) - 1;
constexpr std::uintptr_t one_use = std::uintptr_t{1} << (kind_bits + index_bits);

struct Slot {
  std::atomic<std::uintptr_t> handle = 0;  ///< 0: free
  std::uintptr_t uses = 0;                 ///< how often, in the upper bits of a handle
  std::shared_ptr<void> object;
};

constexpr std::size_t slots_per_block = 256;
constexpr std::size_t block_count = (index_mask + 1) / slots_per_block;

/// Grows by blocks, which are never moved or freed, so readers need no lock.
constinit std::array<std::atomic<Slot*>, block_count> blocks = {};

/// Which slots are free.
struct Slots {
  std::mutex mutex;  ///< also guards changes of slots
  std::size_t unused = 0;
  std::deque<std::size_t> freed;  ///< first in, first out: a freed handle stays unknown for as long as possible
};

/// Lives until the program has ended, because handles may be freed by destructors of static objects.
Slots& slots() {
  static Slots* const only = new Slots;
  return *only;
}

Slot* slot_of(std::uintptr_t handle) noexcept {
  const std::size_t index = (handle >> kind_bits) & index_mask;
  Slot* const block = blocks[index / slots_per_block].load(std::memory_order_acquire);
  return block ? block + index % slots_per_block : nullptr;
}

}  // namespace

const char* to_string(Kind kind) noexcept {
  constexpr std::array names{"",      "set",       "page",  "device", "renderer", "servo",
                             "match", "recording", "score", "stroke", "index",    "traces", "lesson"};
  return names[static_cast<std::size_t>(kind)];
}

void* add_handle(Kind kind, std::shared_ptr<void> object) {
  constexpr std::size_t kept = 64;  // freed slots that are not reused while there are unused ones
  Slots& all = slots();
  const std::lock_guard lock(all.mutex);
  std::size_t index;
  if (all.unused > index_mask || all.freed.size() > kept) {
    if (all.freed.empty()) throw std::bad_alloc();
    index = all.freed.front();
    all.freed.pop_front();
  } else {
    index = all.unused;
    auto& block = blocks[index / slots_per_block];
    if (!block.load(std::memory_order_relaxed)) block.store(new Slot[slots_per_block], std::memory_order_release);
    ++all.unused;
  }
  Slot& slot = blocks[index / slots_per_block].load(std::memory_order_relaxed)[index % slots_per_block];
  slot.object = std::move(object);
  slot.uses += one_use;
  const std::uintptr_t handle = slot.uses | (index << kind_bits) | static_cast<std::uintptr_t>(kind);
  slot.handle.store(handle, std::memory_order_release);
  return reinterpret_cast<void*>(handle);
}

std::shared_ptr<void> remove_handle(const void* handle) noexcept {
  const auto value = reinterpret_cast<std::uintptr_t>(handle);
  Slots& all = slots();
  const std::lock_guard lock(all.mutex);
  Slot* const slot = slot_of(value);
  if (!slot || value == 0 || slot->handle.load(std::memory_order_relaxed) != value) return nullptr;
  try {
    all.freed.push_back((value >> kind_bits) & index_mask);
  } catch (const std::bad_alloc&) {
    // The slot is lost, but not the object.
  }
  slot->handle.store(0, std::memory_order_relaxed);
  return std::exchange(slot->object, nullptr);
}

const std::shared_ptr<void>* find_handle(Kind kind, const void* handle) noexcept {
  const auto value = reinterpret_cast<std::uintptr_t>(handle);
  if ((value & kind_mask) != static_cast<std::uintptr_t>(kind)) return nullptr;
  const Slot* const slot = slot_of(value);
  return slot && slot->handle.load(std::memory_order_acquire) == value ? &slot->object : nullptr;
}

Kind kind_of_handle(const void* handle) noexcept {
  const auto kind = static_cast<Kind>(reinterpret_cast<std::uintptr_t>(handle) & kind_mask);
  return kind != Kind{} && kind <= Kind::lesson && find_handle(kind, handle) ? kind : Kind{};
}

}  // namespace calligraphy::c
