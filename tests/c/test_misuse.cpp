// Whatever is given to the C interface that it cannot use is an error code with its text, and nothing else happens.
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "c_interface.hpp"
#include "special_values.hpp"
#include "temporary_directory.hpp"

using calligraphy::TemporaryDirectory;
using namespace calligraphy_test;

namespace {

/// One of each kind of handle, and a valid struct of each kind.
struct Everything {
  Owned<calligraphy_set> set = built_in_set();
  Owned<calligraphy_page> page = page_of("永");
  calligraphy_capabilities capabilities = profile();
  calligraphy_renderer_options options = options_for(capabilities);
  Owned<calligraphy_renderer> renderer = renderer_of(page.get(), capabilities);
  Owned<calligraphy_device> device = simulated_device(capabilities);
  Owned<calligraphy_device> host = host_device(capabilities), pointer;
  Owned<calligraphy_servo> servo = servo_of(device.get(), renderer.get());
  Owned<calligraphy_match> match;
  Owned<calligraphy_index> index;
  Owned<calligraphy_recording> recording;
  Owned<calligraphy_score> score;
  Owned<calligraphy_traces> traces;
  Owned<calligraphy_renderer> guided;  ///< by a law that was told of a stroke
  const calligraphy_active_stroke* stroke = nullptr;
  calligraphy_mapping mapping = sized<calligraphy_mapping>();
  calligraphy_tick tick = sized<calligraphy_tick>();
  calligraphy_device_state state = sized<calligraphy_device_state>();

  Everything() {
    REQUIRE(calligraphy_page_mapping(page.get(), CALLIGRAPHY_UPRIGHT, 1.0, &mapping) == CALLIGRAPHY_OK);
    calligraphy_device* pointer_handle = nullptr;
    REQUIRE(calligraphy_pointer_device_create(&capabilities, nullptr, nullptr, &mapping, &pointer_handle) ==
            CALLIGRAPHY_OK);
    pointer.reset(pointer_handle);
    calligraphy_match* match_handle = nullptr;
    REQUIRE(calligraphy_match_strokes(page.get(), 0, nullptr, nullptr, 0, CALLIGRAPHY_TOLERANCE_NORMAL, nullptr,
                                      nullptr, &match_handle) == CALLIGRAPHY_OK);
    match.reset(match_handle);
    calligraphy_index* index_handle = nullptr;
    REQUIRE(calligraphy_index_create(set.get(), &index_handle) == CALLIGRAPHY_OK);
    index.reset(index_handle);
    calligraphy_recording* recording_handle = nullptr;
    REQUIRE(calligraphy_recording_create(page.get(), 0.0, &recording_handle) == CALLIGRAPHY_OK);
    recording.reset(recording_handle);
    calligraphy_score* score_handle = nullptr;
    REQUIRE(calligraphy_score_recording(recording.get(), CALLIGRAPHY_TOLERANCE_NORMAL, &score_handle) ==
            CALLIGRAPHY_OK);
    score.reset(score_handle);
    calligraphy_traces* traces_handle = nullptr;
    REQUIRE(calligraphy_traces_create(&traces_handle) == CALLIGRAPHY_OK);
    traces.reset(traces_handle);
    guide();
  }

  /// A pen is put down at the start of a stroke.
  void guide() {
    auto law = sized<calligraphy_guidance_functions>();
    law.user = &stroke;
    law.begin = [](void* user, const calligraphy_active_stroke* told) {
      *static_cast<const calligraphy_active_stroke**>(user) = told;
    };
    law.force = [](void*, const calligraphy_guidance_input*, calligraphy_guidance_terms*) { return 0; };
    options.guidance_law = CALLIGRAPHY_GUIDANCE_OWN;
    options.guidance_functions = &law;
    guided = renderer_of(page.get(), capabilities, &options, &mapping);
    options = options_for(capabilities);
    auto first = sized<calligraphy_stroke>();
    REQUIRE(calligraphy_page_stroke(page.get(), 0, 0, &first) == CALLIGRAPHY_OK);
    auto sample = sized<calligraphy_device_state>();
    for (int i = 0; i < 20; ++i) {
      const double tip[3] = {first.start[0], first.start[1], 1e-3 - 1e-4 * i};
      REQUIRE(calligraphy_mapping_to_device(&mapping, tip, sample.position) == CALLIGRAPHY_OK);
      sample.time = 1e-3 * i;
      REQUIRE(calligraphy_renderer_update(guided.get(), &sample, &tick) == CALLIGRAPHY_OK);
    }
    REQUIRE(stroke != nullptr);
  }
};

std::vector<std::pair<std::string, void*>> handles_of(const Everything& all) {
  return {{"set", all.set.get()},
          {"page", all.page.get()},
          {"device", all.device.get()},
          {"renderer", all.renderer.get()},
          {"servo", all.servo.get()},
          {"match", all.match.get()},
          {"recording", all.recording.get()},
          {"score", all.score.get()},
          {"index", all.index.get()},
          {"traces", all.traces.get()},
          {"stroke", const_cast<calligraphy_active_stroke*>(all.stroke)}};
}

/// A call with a handle of a kind; every function that takes one occurs.
struct HandleCall {
  const char* function;
  const char* kind;
  std::function<calligraphy_status(void*)> call;
};

template <class Handle>
Handle* as(void* handle) {
  return static_cast<Handle*>(handle);
}

std::vector<HandleCall> handle_calls(Everything& all) {
  static std::int32_t number;
  static std::uint32_t code;
  static std::size_t count;
  static const char* text;
  static double points[3];
  static auto placed = sized<calligraphy_placed_character>();
  static auto info = sized<calligraphy_page_info>();
  static auto stroke = sized<calligraphy_stroke>();
  static auto drawn = sized<calligraphy_drawn_stroke>();
  static auto remark = sized<calligraphy_remark>();
  static auto servo_state = sized<calligraphy_servo_state>();
  static calligraphy_page* page;
  static calligraphy_renderer* renderer;
  static calligraphy_servo* servo;
  static calligraphy_match* match;
  static calligraphy_index* index;
  static calligraphy_recording* recording;
  static calligraphy_score* score;
  static auto character_score = sized<calligraphy_character_score>();
  static auto stroke_score = sized<calligraphy_stroke_score>();
  static auto pen_down_score = sized<calligraphy_pen_down_score>();
  static auto place = sized<calligraphy_stroke_place>();
  static auto text_character = sized<calligraphy_text_character>();
  static auto trace_info = sized<calligraphy_trace_info>();
  using Set = calligraphy_set;
  using Page = calligraphy_page;
  using Renderer = calligraphy_renderer;
  using Device = calligraphy_device;
  using Servo = calligraphy_servo;
  using Match = calligraphy_match;
  using Index = calligraphy_index;
  using Recording = calligraphy_recording;
  using Score = calligraphy_score;
  using Traces = calligraphy_traces;
  return {
      {"set_next", "set", [](void* h) { return calligraphy_set_next(as<Set>(h), 0, &code); }},
      {"set_stroke_count", "set", [](void* h) { return calligraphy_set_stroke_count(as<Set>(h), U'永', &number); }},
      {"text_read", "set", [](void* h) { return calligraphy_text_read(as<Set>(h), "永", 0, &text_character); }},
      {"page_lay_out", "set",
       [](void* h) { return calligraphy_page_lay_out(as<Set>(h), "永", nullptr, nullptr, &page); }},
      {"page_character", "page", [](void* h) { return calligraphy_page_character(as<Page>(h), 0, &placed); }},
      {"page_read_info", "page", [](void* h) { return calligraphy_page_read_info(as<Page>(h), &info); }},
      {"page_stroke", "page", [](void* h) { return calligraphy_page_stroke(as<Page>(h), 0, 0, &stroke); }},
      {"page_polyline", "page",
       [](void* h) { return calligraphy_page_polyline(as<Page>(h), 0, 0, CALLIGRAPHY_PATH, 0.0, nullptr, 0, &count); }},
      {"page_mapping", "page",
       [&](void* h) { return calligraphy_page_mapping(as<Page>(h), CALLIGRAPHY_DESK, 1.0, &all.mapping); }},
      {"renderer_create", "page",
       [&](void* h) {
         return calligraphy_renderer_create(as<Page>(h), nullptr, &all.capabilities, nullptr, &renderer);
       }},
      {"match_strokes", "page",
       [](void* h) {
         return calligraphy_match_strokes(as<Page>(h), 0, nullptr, nullptr, 0, 0, nullptr, nullptr, &match);
       }},
      {"index_create", "set", [](void* h) { return calligraphy_index_create(as<Set>(h), &index); }},
      {"index_recognise", "index",
       [](void* h) {
         return calligraphy_index_recognise(as<Index>(h), nullptr, nullptr, 0, nullptr, nullptr, 0, &count);
       }},
      {"match_accepted", "match", [](void* h) { return calligraphy_match_accepted(as<Match>(h), &number); }},
      {"recording_create", "page",
       [](void* h) { return calligraphy_recording_create(as<Page>(h), 1000.0, &recording); }},
      {"device_point", "device",
       [](void* h) { return calligraphy_device_move_pointer(as<Device>(h), 0.0, 0.0, 0.5, 0); }},
      {"device_move_pen", "device",
       [](void* h) { return calligraphy_device_move_pen(as<Device>(h), 0.0, 0.0, 0.5, 0, nullptr); }},
      {"device_intend", "device", [](void* h) { return calligraphy_device_intend(as<Device>(h), points, nullptr); }},
      {"device_advance", "device", [](void* h) { return calligraphy_device_advance(as<Device>(h), 1e-3); }},
      {"device_supply", "device", [&](void* h) { return calligraphy_device_supply(as<Device>(h), &all.state); }},
      {"device_read", "device", [&](void* h) { return calligraphy_device_read(as<Device>(h), &all.state); }},
      {"device_write", "device", [](void* h) { return calligraphy_device_write(as<Device>(h), points); }},
      {"servo_create", "device",
       [&](void* h) { return calligraphy_servo_create(as<Device>(h), all.renderer.get(), &servo); }},
      {"servo_create", "renderer",
       [&](void* h) { return calligraphy_servo_create(all.device.get(), as<Renderer>(h), &servo); }},
      {"renderer_effective_options", "renderer",
       [&](void* h) { return calligraphy_renderer_effective_options(as<Renderer>(h), &all.options); }},
      {"renderer_clipped", "renderer", [](void* h) { return calligraphy_renderer_clipped(as<Renderer>(h), &text); }},
      {"renderer_update", "renderer",
       [&](void* h) { return calligraphy_renderer_update(as<Renderer>(h), &all.state, &all.tick); }},
      {"renderer_restart", "renderer", [](void* h) { return calligraphy_renderer_restart(as<Renderer>(h)); }},
      {"renderer_skip_stroke", "renderer",
       [](void* h) { return calligraphy_renderer_skip_stroke(as<Renderer>(h), &number); }},
      {"servo_step", "servo", [&](void* h) { return calligraphy_servo_step(as<Servo>(h), 0.0, &all.tick); }},
      {"servo_release", "servo", [](void* h) { return calligraphy_servo_release(as<Servo>(h)); }},
      {"servo_read_state", "servo", [](void* h) { return calligraphy_servo_read_state(as<Servo>(h), &servo_state); }},
      {"match_drawn", "match", [](void* h) { return calligraphy_match_drawn(as<Match>(h), 0, &drawn); }},
      {"match_remark_count", "match", [](void* h) { return calligraphy_match_remark_count(as<Match>(h), &number); }},
      {"match_remark", "match", [](void* h) { return calligraphy_match_remark(as<Match>(h), 0, &remark); }},
      {"match_remark_text", "match",
       [](void* h) { return calligraphy_match_remark_text(as<Match>(h), 0, "zh", &text); }},
      {"recording_add", "recording", [&](void* h) { return calligraphy_recording_add(as<Recording>(h), &all.tick); }},
      {"recording_add_with_input", "recording",
       [&](void* h) { return calligraphy_recording_add_with_input(as<Recording>(h), &all.tick, &all.state); }},
      {"recording_input", "recording",
       [&](void* h) { return calligraphy_recording_input(as<Recording>(h), 0, &all.state); }},
      {"traces_begin", "traces", [](void* h) { return calligraphy_traces_begin(as<Traces>(h), U'十', "a", 0.0); }},
      {"traces_begin_path", "traces",
       [](void* h) { return calligraphy_traces_begin_path(as<Traces>(h), CALLIGRAPHY_PEN_DOWN); }},
      {"traces_add", "traces",
       [](void* h) { return calligraphy_traces_add(as<Traces>(h), 0.5, 0.5, 0.0, nullptr, -1); }},
      {"traces_text", "traces", [](void* h) { return calligraphy_traces_text(as<Traces>(h), nullptr, &text); }},
      {"traces_count", "traces", [](void* h) { return calligraphy_traces_count(as<Traces>(h), &number); }},
      {"traces_read_info", "traces",
       [](void* h) { return calligraphy_traces_read_info(as<Traces>(h), 0, &trace_info); }},
      {"traces_read_path", "traces",
       [](void* h) {
         return calligraphy_traces_read_path(as<Traces>(h), 0, CALLIGRAPHY_PEN_DOWN, 0, nullptr, nullptr, 0, &count);
       }},
      {"score_recording", "recording",
       [](void* h) { return calligraphy_score_recording(as<Recording>(h), CALLIGRAPHY_TOLERANCE_NORMAL, &score); }},
      {"score_character", "score",
       [](void* h) { return calligraphy_score_character(as<Score>(h), 0, &character_score); }},
      {"score_stroke", "score", [](void* h) { return calligraphy_score_stroke(as<Score>(h), 0, 0, &stroke_score); }},
      {"score_pen_down", "score",
       [](void* h) { return calligraphy_score_pen_down(as<Score>(h), 0, 0, &pen_down_score); }},
      {"active_stroke_at", "stroke",
       [](void* h) { return calligraphy_active_stroke_at(as<calligraphy_active_stroke>(h), 0.0, &place); }},
      {"score_match", "score", [](void* h) { return calligraphy_score_match(as<Score>(h), 0, &match); }},
  };
}

/// A call that must fail with a status and this in its text.
struct BadCall {
  const char* what;
  calligraphy_status status;
  const char* text;
  std::function<calligraphy_status()> call;
};

void check(const std::vector<BadCall>& calls) {
  for (const BadCall& bad : calls) {
    CAPTURE(bad.what);
    CHECK(bad.call() == bad.status);
    CHECK(error_says(bad.text));
  }
}

}  // namespace

TEST_CASE("a handle that is null, was freed or is of another kind is refused by every function") {
  Everything all;
  const auto handles = handles_of(all);
  const auto freed = handles_of(Everything());
  int elsewhere = 0;
  for (const HandleCall& one : handle_calls(all)) {
    CAPTURE(one.function, one.kind);
    CHECK(one.call(nullptr) == CALLIGRAPHY_INVALID_HANDLE);
    CHECK(last_error() == one.kind + std::string(" is null"));
    for (const auto& [kind, handle] : handles) {
      if (kind == one.kind) continue;
      CHECK(one.call(handle) == CALLIGRAPHY_INVALID_HANDLE);
      CHECK(error_says(std::string(one.kind) + " = 0x"));
      const std::string article = kind == "traces" ? "" : kind == "index" ? "an " : "a ";
      CHECK(error_says(": a handle of " + article + kind));
    }
    for (const auto& [kind, handle] : freed) {
      CHECK(one.call(handle) == CALLIGRAPHY_INVALID_HANDLE);
      CHECK(error_says("no handle, or it was freed"));
    }
    CHECK(one.call(&elsewhere) == CALLIGRAPHY_INVALID_HANDLE);  // of another library
    for (std::uintptr_t bits = 1; bits < 1'000'000'007; bits = bits * 7 + 3) {
      CHECK(one.call(reinterpret_cast<void*>(~bits)) == CALLIGRAPHY_INVALID_HANDLE);
    }
  }
  CHECK(calligraphy_free(&elsewhere) == CALLIGRAPHY_INVALID_HANDLE);
  for (const auto& [kind, handle] : freed) {
    CHECK(calligraphy_free(handle) == CALLIGRAPHY_INVALID_HANDLE);
    CHECK(error_says("freed already"));
  }
  CHECK(calligraphy_free(nullptr) == CALLIGRAPHY_OK);
}

TEST_CASE("a freed handle stays unknown while others come and go") {
  auto first = page_of("永");
  void* const freed = first.get();
  first.reset();
  auto placed = sized<calligraphy_placed_character>();
  std::vector<Owned<calligraphy_page>> alive;
  for (int i = 0; i < 1000; ++i) {
    auto page = page_of("一");
    if (i % 3 == 0) alive.push_back(std::move(page));
    REQUIRE(calligraphy_page_character(static_cast<calligraphy_page*>(freed), 0, &placed) ==
            CALLIGRAPHY_INVALID_HANDLE);
  }
  for (const auto& page : alive) {
    REQUIRE(calligraphy_page_character(page.get(), 0, &placed) == CALLIGRAPHY_OK);
    REQUIRE(placed.code == U'一');
  }
}

TEST_CASE("as many handles as there may be, and one more") {
  const auto page = page_of("一");
  std::vector<Owned<calligraphy_match>> matches;
  calligraphy_match* match = nullptr;
  calligraphy_status status;
  while ((status = calligraphy_match_strokes(page.get(), 0, nullptr, nullptr, 0, CALLIGRAPHY_TOLERANCE_NORMAL, nullptr,
                                             nullptr, &match)) == CALLIGRAPHY_OK) {
    matches.emplace_back(match);
  }
  CHECK(status == CALLIGRAPHY_OUT_OF_MEMORY);
  CHECK(matches.size() > 65'000);
  matches.pop_back();
  REQUIRE(calligraphy_match_strokes(page.get(), 0, nullptr, nullptr, 0, CALLIGRAPHY_TOLERANCE_NORMAL, nullptr, nullptr,
                                    &match) == CALLIGRAPHY_OK);
  matches.emplace_back(match);
}

TEST_CASE("threads may create and free handles at the same time") {
  std::vector<std::thread> threads;
  std::atomic<int> failed = 0;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&failed] {
      for (int i = 0; i < 300; ++i) {
        calligraphy_set* set = nullptr;
        std::uint32_t code = 0;
        failed += calligraphy_set_built_in(&set) != CALLIGRAPHY_OK;
        failed += calligraphy_set_next(set, 0, &code) != CALLIGRAPHY_OK;
        failed += calligraphy_free(set) != CALLIGRAPHY_OK;
        failed += calligraphy_set_next(set, 0, &code) != CALLIGRAPHY_INVALID_HANDLE;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(failed == 0);
}

TEST_CASE("a struct of the wrong size is refused, and one of a newer version taken") {
  Everything all;
  const auto update = [&] { return calligraphy_renderer_update(all.renderer.get(), &all.state, &all.tick); };
  REQUIRE(update() == CALLIGRAPHY_OK);
  for (const std::uint32_t size : {0u, 4u, static_cast<std::uint32_t>(sizeof(calligraphy_tick)) - 1, 4097u, ~0u}) {
    all.tick.size = size;
    CHECK(update() == CALLIGRAPHY_INVALID_VALUE);
    CHECK(last_error() == "calligraphy_tick: size = " + std::to_string(size) +
                              ", must be sizeof(calligraphy_tick), at least " +
                              std::to_string(sizeof(calligraphy_tick)));
  }
  all.tick.size = sizeof all.tick;
  all.state.size = 8;
  CHECK(update() == CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("calligraphy_device_state: size = 8"));
  all.options.size = 100;
  calligraphy_renderer* renderer = nullptr;
  CHECK(calligraphy_renderer_create(all.page.get(), nullptr, &all.capabilities, &all.options, &renderer) ==
        CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("calligraphy_renderer_options: size = 100"));
  CHECK(renderer == nullptr);

  // Of a newer version: what this one does not know is zero in results, and must be zero in what is given.
  struct {
    calligraphy_tick tick;
    double later[4];
  } newer = {};
  newer.tick.size = sizeof newer;
  newer.later[3] = 1.0;
  all.state.size = sizeof all.state;
  CHECK(calligraphy_renderer_update(all.renderer.get(), &all.state, &newer.tick) == CALLIGRAPHY_OK);
  CHECK(newer.tick.size == sizeof newer);
  CHECK(newer.later[3] == 0.0);
  struct {
    calligraphy_layout layout;
    double later;
  } layout = {};
  layout.layout.size = sizeof layout;
  calligraphy_page* page = nullptr;
  REQUIRE(calligraphy_page_lay_out(all.set.get(), "永", &layout.layout, nullptr, &page) == CALLIGRAPHY_OK);
  REQUIRE(calligraphy_free(page) == CALLIGRAPHY_OK);
  layout.later = 1.0;
  CHECK(calligraphy_page_lay_out(all.set.get(), "永", &layout.layout, nullptr, &page) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("layout: it sets members that version 0.2.0 does not have"));
  struct {
    calligraphy_device_state state;
    double later;
  } sample = {all.state, 0.0};
  sample.state.size = sizeof sample;
  for (const auto& give : std::vector<std::function<calligraphy_status()>>{
           [&] { return calligraphy_renderer_update(all.renderer.get(), &sample.state, &all.tick); },
           [&] { return calligraphy_device_supply(all.host.get(), &sample.state); }}) {
    sample.later = 0.0;
    CHECK(give() == CALLIGRAPHY_OK);
    sample.later = 1.0;
    CHECK(give() == CALLIGRAPHY_INVALID_VALUE);
    CHECK(error_says("device_state: it sets members that version 0.2.0 does not have"));
  }
  CHECK(calligraphy_device_read(all.device.get(), &sample.state) == CALLIGRAPHY_OK);  // a result
  CHECK(sample.later == 0.0);
  CHECK(sample.state.size == sizeof sample);
}

TEST_CASE("a null pointer, a wrong index and a number that is none are refused by name") {
  Everything all;
  const double nan[3] = {0.0, not_a_number, 0.0}, good[3] = {0.0, 0.0, 0.01};
  auto placed = sized<calligraphy_placed_character>();
  auto stroke = sized<calligraphy_stroke>();
  auto layout = sized<calligraphy_layout>();
  layout.em = not_a_number;
  auto negative = sized<calligraphy_layout>();
  negative.gap = -0.1;
  auto grip = sized<calligraphy_grip>();
  grip.stiffness = not_a_number;
  auto bad_capabilities = all.capabilities;
  bad_capabilities.peak_force = not_a_number;
  auto no_force = all.capabilities;
  no_force.peak_force = 0.0;
  auto bad_mapping = all.mapping;
  bad_mapping.rotation[0] = 2.0;
  auto bad_options = all.options;
  bad_options.paper_stiffness = not_a_number;
  auto bad_choice = all.options;
  bad_choice.stiffness_check = 3;
  auto no_state = sized<calligraphy_tick>(), no_status = no_state;
  no_state.state = 4;
  no_status.status = -1;
  calligraphy_set* set = nullptr;
  calligraphy_page* page = nullptr;
  calligraphy_device* device = nullptr;
  calligraphy_renderer* renderer = nullptr;
  calligraphy_match* match = nullptr;
  const char* text = nullptr;
  calligraphy_recording* recording = nullptr;
  calligraphy_score* score = nullptr;
  std::size_t count = 0;
  std::uint32_t code = 0;
  std::int32_t number = 0;
  double points[3] = {};
  char hint[128] = {};
  const std::uint32_t one_point = 1;
  constexpr auto value = CALLIGRAPHY_INVALID_VALUE;
  constexpr auto normal = CALLIGRAPHY_TOLERANCE_NORMAL;
  const auto polyline = [&](std::int32_t character, std::int32_t index, int shape, double tolerance) {
    return calligraphy_page_polyline(all.page.get(), character, index, shape, tolerance, points, 1, &count);
  };
  auto read = sized<calligraphy_text_character>();
  const auto no_law = sized<calligraphy_guidance_functions>();
  auto later_stylus = sized<calligraphy_stylus>();
  later_stylus.known = 64;
  calligraphy_traces* no_traces = nullptr;
  std::int32_t buttons[1] = {};
  calligraphy_traces* const traces = all.traces.get();
  const auto read_path = [&](std::int32_t trace, std::int32_t place, std::int32_t path) {
    return calligraphy_traces_read_path(traces, trace, place, path, nullptr, buttons, 1, &count);
  };
  const auto matched = [&](const double* from, const std::uint32_t* sizes, const void* forms = nullptr,
                           const void* others = nullptr) {
    return calligraphy_match_strokes(all.page.get(), 0, from, sizes, 1, normal,
                                     static_cast<const calligraphy_set*>(forms),
                                     static_cast<const calligraphy_index*>(others), &match);
  };
  const auto create_with = [&](std::int32_t law, const calligraphy_guidance_functions* functions) {
    auto options = all.options;
    options.guidance_law = law;
    options.guidance_functions = functions;
    return calligraphy_renderer_create(all.page.get(), nullptr, &all.capabilities, &options, &renderer);
  };
  check({
      {"built in", value, "set is null", [&] { return calligraphy_set_built_in(nullptr); }},
      {"open", value, "path is null", [&] { return calligraphy_set_open(nullptr, &set); }},
      {"open", value, "set is null", [&] { return calligraphy_set_open("a", nullptr); }},
      {"strokes", value, "set is null", [&] { return calligraphy_set_typical_strokes(nullptr); }},
      {"memory", value, "bytes is null", [&] { return calligraphy_set_from_memory(nullptr, 3, nullptr, &set); }},
      {"next", value, "code is null", [&] { return calligraphy_set_next(all.set.get(), 0, nullptr); }},
      {"next", CALLIGRAPHY_NOT_FOUND, "at or after", [&] { return calligraphy_set_next(all.set.get(), ~0u, &code); }},
      {"strokes", value, "stroke_count is null",
       [&] { return calligraphy_set_stroke_count(all.set.get(), U'永', nullptr); }},
      {"strokes", CALLIGRAPHY_NOT_FOUND, "龘 (U+9F98)",
       [&] { return calligraphy_set_stroke_count(all.set.get(), U'龘', &number); }},
      {"text", CALLIGRAPHY_NOT_FOUND, "the text has 1 characters",
       [&] { return calligraphy_text_read(all.set.get(), " 永", 1, &read); }},
      {"text", value, "index = -1", [&] { return calligraphy_text_read(all.set.get(), "永", -1, &read); }},
      {"text", value, "text is null",
       [&] { return calligraphy_page_lay_out(all.set.get(), nullptr, nullptr, nullptr, &page); }},
      {"text", value, "text is empty",
       [&] { return calligraphy_page_lay_out(all.set.get(), "", nullptr, nullptr, &page); }},
      {"text", CALLIGRAPHY_FORMAT_ERROR, "byte",
       [&] { return calligraphy_page_lay_out(all.set.get(), "\xff", nullptr, nullptr, &page); }},
      {"text", CALLIGRAPHY_NOT_FOUND, "龘",
       [&] { return calligraphy_page_lay_out(all.set.get(), "永龘", nullptr, nullptr, &page); }},
      {"text", value, "6 of 7 characters fit",
       [&] { return calligraphy_page_lay_out(all.set.get(), "一一一一一一一", nullptr, nullptr, &page); }},
      {"page", value, "page is null",
       [&] { return calligraphy_page_lay_out(all.set.get(), "永", nullptr, nullptr, nullptr); }},
      {"layout", value, "layout.em = nan m, must be finite and at least 0",
       [&] { return calligraphy_page_lay_out(all.set.get(), "永", &layout, nullptr, &page); }},
      {"layout", value, "layout.gap = -0.1 m",
       [&] { return calligraphy_page_lay_out(all.set.get(), "永", &negative, nullptr, &page); }},
      {"character", value, "character = 1, must be an index below 1",
       [&] { return calligraphy_page_character(all.page.get(), 1, &placed); }},
      {"character", value, "character = -1", [&] { return calligraphy_page_stroke(all.page.get(), -1, 0, &stroke); }},
      {"stroke", value, "stroke = 5, must be an index below 5",
       [&] { return calligraphy_page_stroke(all.page.get(), 0, 5, &stroke); }},
      {"stroke", value, "calligraphy_stroke is null",
       [&] { return calligraphy_page_stroke(all.page.get(), 0, 0, nullptr); }},
      {"polyline", value, "stroke = -1", [&] { return polyline(0, -1, CALLIGRAPHY_PATH, 0.0); }},
      {"polyline", value, "shape = 2, must be 0 to 1", [&] { return polyline(0, 0, 2, 0.0); }},
      {"polyline", value, "tolerance = nan", [&] { return polyline(0, 0, CALLIGRAPHY_PATH, not_a_number); }},
      {"polyline", value, "tolerance = -1", [&] { return polyline(0, 0, CALLIGRAPHY_OUTLINE, -1.0); }},
      {"polyline", CALLIGRAPHY_TOO_SMALL, "capacity = 1, but",
       [&] { return polyline(0, 0, CALLIGRAPHY_OUTLINE, 0.0); }},
      {"pose", value, "pose = 2", [&] { return calligraphy_page_mapping(all.page.get(), 2, 1.0, &all.mapping); }},
      {"scale", value, "scale",
       [&] { return calligraphy_page_mapping(all.page.get(), CALLIGRAPHY_DESK, not_a_number, &all.mapping); }},
      {"profile", value, "name is null", [&] { return calligraphy_device_profile(nullptr, &all.capabilities); }},
      {"profile", value, "phantasm", [&] { return calligraphy_device_profile("phantasm", &all.capabilities); }},
      {"device", value, "calligraphy_capabilities is null",
       [&] { return calligraphy_simulated_device_create(nullptr, nullptr, good, &device); }},
      {"device", value, "position is null",
       [&] { return calligraphy_simulated_device_create(&all.capabilities, nullptr, nullptr, &device); }},
      {"device", value, "position = nan m",
       [&] { return calligraphy_simulated_device_create(&all.capabilities, nullptr, nan, &device); }},
      {"device", value, "stiffness",
       [&] { return calligraphy_simulated_device_create(&all.capabilities, &grip, good, &device); }},
      {"device", value, "peak_force = nan N",
       [&] { return calligraphy_simulated_device_create(&bad_capabilities, nullptr, good, &device); }},
      {"pointer", value, "calligraphy_mapping is null",
       [&] { return calligraphy_pointer_device_create(&all.capabilities, nullptr, nullptr, nullptr, &device); }},
      {"pointer", value, "rotation",
       [&] { return calligraphy_pointer_device_create(&all.capabilities, nullptr, nullptr, &bad_mapping, &device); }},
      {"point", CALLIGRAPHY_INVALID_HANDLE, "expected one of calligraphy_pointer_device_create()",
       [&] { return calligraphy_device_move_pointer(all.device.get(), 0.0, 0.0, 0.5, 0); }},
      {"point", value, "nan", [&] { return calligraphy_device_move_pointer(all.pointer.get(), nan[1], 0.0, 0.5, 0); }},
      {"point", value, "pressure 1.5",
       [&] { return calligraphy_device_move_pointer(all.pointer.get(), 0.0, 0.0, 1.5, 0); }},
      {"pen", value, "calligraphy_stylus: known = 64, must be a sum of bits, at most 63",
       [&] { return calligraphy_device_move_pen(all.pointer.get(), 0.0, 0.0, 0.5, 0, &later_stylus); }},
      {"intend", CALLIGRAPHY_INVALID_HANDLE, "expected one of calligraphy_simulated_device_create()",
       [&] { return calligraphy_device_intend(all.pointer.get(), good, nullptr); }},
      {"intend", value, "velocity = nan m/s", [&] { return calligraphy_device_intend(all.device.get(), good, nan); }},
      {"advance", value, "nan", [&] { return calligraphy_device_advance(all.device.get(), not_a_number); }},
      {"advance", CALLIGRAPHY_INVALID_HANDLE, "expected one of calligraphy_simulated_device_create()",
       [&] { return calligraphy_device_advance(all.pointer.get(), 1e-3); }},
      {"read", value, "calligraphy_device_state is null",
       [&] { return calligraphy_device_read(all.device.get(), nullptr); }},
      {"write", value, "force is null", [&] { return calligraphy_device_write(all.device.get(), nullptr); }},
      {"write", value, "must be finite: it counts as zero",
       [&] { return calligraphy_device_write(all.device.get(), nan); }},
      {"read", CALLIGRAPHY_INVALID_HANDLE, "one of calligraphy_host_device_create() is read and written by the program",
       [&] { return calligraphy_device_read(all.host.get(), &all.state); }},
      {"write", CALLIGRAPHY_INVALID_HANDLE,
       "one of calligraphy_host_device_create() is read and written by the program",
       [&] { return calligraphy_device_write(all.host.get(), good); }},
      {"supply", CALLIGRAPHY_INVALID_HANDLE, "expected one of calligraphy_host_device_create()",
       [&] { return calligraphy_device_supply(all.device.get(), &all.state); }},
      {"supply", value, "calligraphy_device_state is null",
       [&] { return calligraphy_device_supply(all.host.get(), nullptr); }},
      {"host", value, "peak_force = 0 N, must be above 0, or infinite",
       [&] { return calligraphy_host_device_create(&no_force, &device); }},
      {"mapping", value, "page = nan m", [&] { return calligraphy_mapping_to_device(&all.mapping, nan, points); }},
      {"mapping", value, "device is null", [&] { return calligraphy_mapping_to_device(&all.mapping, good, nullptr); }},
      {"preset", value, "preset = 3",
       [&] { return calligraphy_renderer_options_for(&all.capabilities, 3, 1.0, normal, &all.options); }},
      {"tolerance", value, "tolerance = -1",
       [&] {
         return calligraphy_renderer_options_for(&all.capabilities, CALLIGRAPHY_PRESET_DEVICE, 1.0, -1, &all.options);
       }},
      {"scale", value, "scale",
       [&] {
         return calligraphy_renderer_options_for(&all.capabilities, CALLIGRAPHY_PRESET_DEVICE, not_a_number, normal,
                                                 &all.options);
       }},
      {"renderer", value, "paper.stiffness = nan N/m",
       [&] {
         return calligraphy_renderer_create(all.page.get(), nullptr, &all.capabilities, &bad_options, &renderer);
       }},
      {"renderer", value, "stiffness_check = 3, must be 0 to 2",
       [&] { return calligraphy_renderer_create(all.page.get(), nullptr, &all.capabilities, &bad_choice, &renderer); }},
      {"law", value, "guidance_law = 4, must be 0 to 3", [&] { return create_with(4, nullptr); }},
      {"law", value, "calligraphy_guidance_functions is null",
       [&] { return create_with(CALLIGRAPHY_GUIDANCE_OWN, nullptr); }},
      {"law", value, "calligraphy_guidance_functions: force is null",
       [&] { return create_with(CALLIGRAPHY_GUIDANCE_OWN, &no_law); }},
      {"law", value, "guidance_functions are set, but guidance_law = 1 is not CALLIGRAPHY_GUIDANCE_OWN",
       [&] { return create_with(CALLIGRAPHY_GUIDANCE_SATURATING, &no_law); }},
      {"free", CALLIGRAPHY_INVALID_HANDLE, "a stroke is freed with its renderer",
       [&] { return calligraphy_free(const_cast<calligraphy_active_stroke*>(all.stroke)); }},
      {"place", value, "calligraphy_stroke_place is null",
       [&] { return calligraphy_active_stroke_at(all.stroke, 0.0, nullptr); }},
      {"renderer", value, "renderer is null",
       [&] { return calligraphy_renderer_create(all.page.get(), nullptr, &all.capabilities, nullptr, nullptr); }},
      {"update", value, "calligraphy_device_state is null",
       [&] { return calligraphy_renderer_update(all.renderer.get(), nullptr, &all.tick); }},
      {"update", value, "calligraphy_tick is null",
       [&] { return calligraphy_renderer_update(all.renderer.get(), &all.state, nullptr); }},
      {"hint", value, "text is null", [&] { return calligraphy_hint_text(&all.tick, "en", nullptr, 3); }},
      {"hint", value, "language \"xx\": expected one of ",
       [&] { return calligraphy_hint_text(&all.tick, "xx", hint, sizeof hint); }},
      {"step", value, "now = nan s", [&] { return calligraphy_servo_step(all.servo.get(), not_a_number, nullptr); }},
      {"match", value, "points is null", [&] { return matched(nullptr, &one_point); }},
      {"match", value, "path_sizes is null", [&] { return matched(points, nullptr); }},
      {"match", value, "not finite", [&] { return matched(nan, &one_point); }},
      {"forms", CALLIGRAPHY_INVALID_HANDLE, "set = 0x", [&] { return matched(points, &one_point, all.page.get()); }},
      {"others", CALLIGRAPHY_INVALID_HANDLE, "index = 0x",
       [&] { return matched(points, &one_point, nullptr, all.page.get()); }},
      {"remark", value, "language \"tlh\": expected one of ",
       [&] { return calligraphy_match_remark_text(all.match.get(), 0, "tlh", &text); }},
      {"remark", value, "text is null",
       [&] { return calligraphy_match_remark_text(all.match.get(), 0, nullptr, nullptr); }},
      {"match", value, "path = 0",
       [&] {
         auto drawn = sized<calligraphy_drawn_stroke>();
         return calligraphy_match_drawn(all.match.get(), 0, &drawn);
       }},
      {"recording", value, "rate = -1 Hz",
       [&] { return calligraphy_recording_create(all.page.get(), -1.0, &recording); }},
      {"recording", value, "rate = nan Hz",
       [&] { return calligraphy_recording_create(all.page.get(), not_a_number, &recording); }},
      {"recording", value, "recording is null",
       [&] { return calligraphy_recording_create(all.page.get(), 0.0, nullptr); }},
      {"add", value, "calligraphy_tick is null",
       [&] { return calligraphy_recording_add(all.recording.get(), nullptr); }},
      {"add", value, "state = 4, must be 0 to 3",
       [&] { return calligraphy_recording_add(all.recording.get(), &no_state); }},
      {"add", value, "status = -1, must be 0 to 5",
       [&] { return calligraphy_recording_add(all.recording.get(), &no_status); }},
      {"add", value, "calligraphy_device_state is null",
       [&] { return calligraphy_recording_add_with_input(all.recording.get(), &all.tick, nullptr); }},
      {"input", value, "tick = 0, must be an index below 0",
       [&] { return calligraphy_recording_input(all.recording.get(), 0, &all.state); }},
      {"traces", value, "traces is null", [&] { return calligraphy_traces_create(nullptr); }},
      {"traces", value, "bytes is null",
       [&] { return calligraphy_traces_from_memory(nullptr, 3, nullptr, &no_traces); }},
      {"traces", CALLIGRAPHY_FORMAT_ERROR, "memory",
       [&] { return calligraphy_traces_from_memory("S 1 0", 5, nullptr, &no_traces); }},
      {"path", value, "no trace was begun",
       [&] { return calligraphy_traces_begin_path(traces, CALLIGRAPHY_PEN_DOWN); }},
      {"trace", value, "set is null", [&] { return calligraphy_traces_begin(traces, U'十', nullptr, 0.0); }},
      {"trace", value, "em = nan", [&] { return calligraphy_traces_begin(traces, U'十', "a", not_a_number); }},
      {"traces", value, "trace = 0, must be an index below 0",
       [&] { return read_path(0, CALLIGRAPHY_PEN_DOWN, 0); }},
      {"sample", value, "no pen-down and no time in the air was begun",
       [&] {
         REQUIRE(calligraphy_traces_begin(traces, U'十', "a", 0.0) == CALLIGRAPHY_OK);
         return calligraphy_traces_add(traces, 0.5, 0.5, 0.0, nullptr, -1);
       }},
      {"path", value, "place = 2, must be 0 to 1", [&] { return calligraphy_traces_begin_path(traces, 2); }},
      {"text", value, "it has 0 strokes", [&] { return calligraphy_traces_text(traces, nullptr, &text); }},
      {"sample", value, "calligraphy_stylus: known = 64",
       [&] {
         REQUIRE(calligraphy_traces_begin_path(traces, CALLIGRAPHY_PEN_IN_AIR) == CALLIGRAPHY_OK);
         return calligraphy_traces_add(traces, 0.5, 0.5, 0.0, &later_stylus, -1);
       }},
      {"path", value, "the pen is in the air twice in a row",
       [&] {
         REQUIRE(calligraphy_traces_add(traces, 0.5, 0.5, 1.0, nullptr, -1) == CALLIGRAPHY_OK);
         REQUIRE(calligraphy_traces_add(traces, 0.5, 0.5, 1.0, nullptr, -1) == CALLIGRAPHY_OK);
         return calligraphy_traces_begin_path(traces, CALLIGRAPHY_PEN_IN_AIR);
       }},
      {"samples", CALLIGRAPHY_TOO_SMALL, "capacity = 1, but the path has 2 samples",
       [&] { return read_path(0, CALLIGRAPHY_PEN_IN_AIR, 0); }},
      {"samples", value, "path = 0, must be an index below 0", [&] { return read_path(0, CALLIGRAPHY_PEN_DOWN, 0); }},
      {"samples", value, "place = -1", [&] { return read_path(0, -1, 0); }},
      {"sample", value, "the sample has a time of 0 s after 1 s",
       [&] { return calligraphy_traces_add(traces, 0.5, 0.5, 0.0, nullptr, -1); }},
      {"text", value, "stroke 1 has 0 points",
       [&] {
         REQUIRE(calligraphy_traces_begin_path(traces, CALLIGRAPHY_PEN_DOWN) == CALLIGRAPHY_OK);
         return calligraphy_traces_text(traces, nullptr, &text);
       }},
      {"count", value, "count is null", [&] { return calligraphy_traces_count(traces, nullptr); }},
      {"info", value, "calligraphy_trace_info is null",
       [&] { return calligraphy_traces_read_info(traces, 0, nullptr); }},
      {"score", value, "tolerance = 3", [&] { return calligraphy_score_recording(all.recording.get(), 3, &score); }},
      {"score", value, "score is null",
       [&] { return calligraphy_score_recording(all.recording.get(), normal, nullptr); }},
      {"score", value, "calligraphy_character_score is null",
       [&] { return calligraphy_score_character(all.score.get(), 0, nullptr); }},
      {"score", value, "calligraphy_stroke_score is null",
       [&] { return calligraphy_score_stroke(all.score.get(), 0, 4, nullptr); }},
      {"score", value, "path = 0",
       [&] {
         auto pen_down = sized<calligraphy_pen_down_score>();
         return calligraphy_score_pen_down(all.score.get(), 0, 0, &pen_down);
       }},
      {"score", value, "match is null", [&] { return calligraphy_score_match(all.score.get(), 0, nullptr); }},
      {"score", value, "character = -1", [&] { return calligraphy_score_match(all.score.get(), -1, &match); }},
  });
  CHECK(set == nullptr);
  CHECK(page == nullptr);
  CHECK(device == nullptr);
  CHECK(renderer == nullptr);
  CHECK(match == nullptr);
  CHECK(recording == nullptr);
  CHECK(score == nullptr);
  CHECK(no_traces == nullptr);
}

TEST_CASE("a broken set is a format error, a missing one a file error") {
  TemporaryDirectory directory;
  calligraphy_set* set = nullptr;
  const std::string path = (directory.path() / "broken.set").string();
  CHECK(calligraphy_set_open(path.c_str(), &set) == CALLIGRAPHY_FILE_ERROR);
  CHECK(error_says("broken.set"));
  std::ofstream(path) << "no set at all";
  CHECK(calligraphy_set_open(path.c_str(), &set) == CALLIGRAPHY_FORMAT_ERROR);
  CHECK(error_says("broken.set"));
  CHECK(calligraphy_set_from_memory("no set", 6, "here", &set) == CALLIGRAPHY_FORMAT_ERROR);
  CHECK(error_says("here"));
  CHECK(calligraphy_set_from_memory("", 0, nullptr, &set) == CALLIGRAPHY_FORMAT_ERROR);
  CHECK(error_says("memory"));
  CHECK(set == nullptr);
}

TEST_CASE("every thread has its own last error") {
  calligraphy_set* set = nullptr;
  REQUIRE(calligraphy_set_open(nullptr, &set) == CALLIGRAPHY_INVALID_VALUE);
  std::string elsewhere = "?";
  std::thread([&] { elsewhere = calligraphy_last_error(); }).join();
  CHECK(elsewhere.empty());
  std::int32_t count = 0;
  REQUIRE(calligraphy_set_stroke_count(built_in_set().get(), U'永', &count) == CALLIGRAPHY_OK);
  CHECK(last_error() == "path is null");  // success leaves it
}
