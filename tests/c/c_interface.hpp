// What tests of the C interface share.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/c/calligraphy.h>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/practice/page.hpp>

#include "catch.hpp"

namespace calligraphy_test {

/// Frees a handle at the end of its scope.
struct Freed {
  void operator()(void* handle) const { CHECK(calligraphy_free(handle) == CALLIGRAPHY_OK); }
};
template <class Handle>
using Owned = std::unique_ptr<Handle, Freed>;

/// A struct of the C interface with its size, all else zero.
template <class Struct>
Struct sized() {
  Struct result = {};
  result.size = sizeof(Struct);
  return result;
}

inline Owned<calligraphy_set> built_in_set() {
  calligraphy_set* set = nullptr;
  REQUIRE(calligraphy_set_built_in(&set) == CALLIGRAPHY_OK);
  return Owned<calligraphy_set>(set);
}

inline Owned<calligraphy_page> page_of(const char* text) {
  calligraphy_page* page = nullptr;
  REQUIRE(calligraphy_page_lay_out(built_in_set().get(), text, nullptr, nullptr, &page) == CALLIGRAPHY_OK);
  return Owned<calligraphy_page>(page);
}

/// The same page in C++.
inline calligraphy::PracticePage page_in_cpp(std::u32string_view text) {
  std::vector<calligraphy::Character> characters;
  for (const char32_t code : text) characters.push_back(calligraphy::built_in_characters().at(code));
  return calligraphy::lay_out(characters).front();
}

inline calligraphy_capabilities profile(const char* name = "desktop") {
  auto result = sized<calligraphy_capabilities>();
  REQUIRE(calligraphy_device_profile(name, &result) == CALLIGRAPHY_OK);
  return result;
}

inline calligraphy_renderer_options options_for(const calligraphy_capabilities& device,
                                                calligraphy_preset preset = CALLIGRAPHY_PRESET_DEVICE,
                                                double scale = 1.0) {
  auto result = sized<calligraphy_renderer_options>();
  REQUIRE(calligraphy_renderer_options_for(&device, preset, scale, CALLIGRAPHY_TOLERANCE_NORMAL, &result) ==
          CALLIGRAPHY_OK);
  return result;
}

inline Owned<calligraphy_renderer> renderer_of(const calligraphy_page* page, const calligraphy_capabilities& device,
                                               const calligraphy_renderer_options* options = nullptr,
                                               const calligraphy_mapping* mapping = nullptr) {
  calligraphy_renderer* renderer = nullptr;
  REQUIRE(calligraphy_renderer_create(page, mapping, &device, options, &renderer) == CALLIGRAPHY_OK);
  return Owned<calligraphy_renderer>(renderer);
}

inline Owned<calligraphy_device> simulated_device(const calligraphy_capabilities& device,
                                                  const double (&position)[3] = {0.0, 0.0, 0.02}) {
  calligraphy_device* result = nullptr;
  REQUIRE(calligraphy_simulated_device_create(&device, nullptr, position, &result) == CALLIGRAPHY_OK);
  return Owned<calligraphy_device>(result);
}

inline Owned<calligraphy_device> host_device(const calligraphy_capabilities& device) {
  calligraphy_device* result = nullptr;
  REQUIRE(calligraphy_host_device_create(&device, &result) == CALLIGRAPHY_OK);
  return Owned<calligraphy_device>(result);
}

inline Owned<calligraphy_servo> servo_of(calligraphy_device* device, calligraphy_renderer* renderer) {
  calligraphy_servo* result = nullptr;
  REQUIRE(calligraphy_servo_create(device, renderer, &result) == CALLIGRAPHY_OK);
  return Owned<calligraphy_servo>(result);
}

inline std::string last_error() { return calligraphy_last_error(); }

/// Whether this is part of the last error.
inline bool error_says(const std::string& part) {
  UNSCOPED_INFO("last error: " << last_error());
  return last_error().find(part) != std::string::npos;
}

}  // namespace calligraphy_test
