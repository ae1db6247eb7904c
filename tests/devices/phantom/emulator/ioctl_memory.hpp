// Access to the memory of a program that has an emulated device open, through umockdev.
#pragma once

#include <cstring>
#include <memory>
#include <span>

#include <umockdev.h>

namespace calligraphy_test {

struct ReleaseIoctlData {
  void operator()(UMockdevIoctlData* data) const noexcept { umockdev_ioctl_data_unref(data); }
};
/// A copy of part of the program's memory; changes are written back when the call is answered.
using IoctlMemory = std::unique_ptr<UMockdevIoctlData, ReleaseIoctlData>;

/// Target of the pointer at an offset of `from`; null for a null pointer or no bytes.
inline IoctlMemory pointed_to(UMockdevIoctlData* from, std::size_t offset, std::size_t size) {
  if (size == 0) return nullptr;
  GError* error = nullptr;
  UMockdevIoctlData* data = umockdev_ioctl_data_resolve(from, offset, size, &error);
  g_clear_error(&error);
  return IoctlMemory(data);
}

template <typename T>
T read_as(const UMockdevIoctlData* data) {
  T value{};
  std::memcpy(&value, data->data, std::min(sizeof value, static_cast<std::size_t>(data->data_len)));
  return value;
}

inline void put(UMockdevIoctlData* data, std::size_t offset, std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  umockdev_ioctl_data_update(data, offset, const_cast<std::uint8_t*>(bytes.data()), static_cast<int>(bytes.size()));
}

template <typename T>
void put_value(UMockdevIoctlData* data, std::size_t offset, const T& value) {
  put(data, offset, {reinterpret_cast<const std::uint8_t*>(&value), sizeof value});
}

}  // namespace calligraphy_test
