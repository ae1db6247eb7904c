#include "serial_framing.hpp"

#include <algorithm>

namespace calligraphy::phantom {
namespace {

constexpr std::byte first_mark{0xA5};
constexpr std::byte second_mark{0x5A};

}  // namespace

void SerialFrames::reset() noexcept {
  skipped_ += size_;
  size_ = 0;
}

bool SerialFrames::add(std::byte byte) noexcept {
  frame_[size_++] = byte;
  if (size_ <= header_size) resynchronise();
  return size_ >= header_size && size_ == header_size + std::to_integer<std::size_t>(frame_[3]);
}

void SerialFrames::resynchronise() noexcept {
  while (!may_begin_frame()) {
    std::copy(frame_.begin() + 1, frame_.begin() + static_cast<std::ptrdiff_t>(size_), frame_.begin());
    --size_;
    ++skipped_;
  }
}

bool SerialFrames::may_begin_frame() const noexcept {
  if (size_ >= 1 && frame_[0] != first_mark) return false;
  if (size_ >= 2 && frame_[1] != second_mark) return false;
  if (!expected_) return true;
  if (size_ >= 3 && frame_[2] != std::byte{expected_->code}) return false;
  return size_ < 4 || frame_[3] == std::byte{expected_->length};
}

std::size_t write_serial_frame(std::uint8_t code, std::span<const std::byte> payload,
                               std::span<std::byte> frame) noexcept {
  const std::size_t size = 4 + payload.size();
  if (payload.size() > 255 || frame.size() < size) return 0;
  frame[0] = first_mark;
  frame[1] = second_mark;
  frame[2] = std::byte{code};
  frame[3] = static_cast<std::byte>(payload.size());
  std::ranges::copy(payload, frame.begin() + 4);
  return size;
}

}  // namespace calligraphy::phantom
