// Cost of a character set: size, opening, lookup, preparing a stroke, memory; compared with the plain alternatives, a
// hash map of characters and a JSON text for each, in the same rounds.
// usage: benchmark_character_set [FILE] [--benchmark_...]; FILE: a set made by `calligraphy import`; default: the
// built-in set.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <unordered_map>
#include <vector>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <calligraphy/calligraphy.hpp>

#include "../timing.hpp"
#include "resident.hpp"

namespace {

using namespace calligraphy;
using timing::Clock, timing::nanoseconds, timing::percentile;
using Json = nlohmann::json;

constexpr int queries_per_round = 256;  // enough to make the overhead of the clock negligible

struct Precision {
  CoordinatePrecision precision;
  const char* name;
};
constexpr Precision precisions[] = {{CoordinatePrecision::coarse, "coarse"},
                                    {CoordinatePrecision::standard, "standard"},
                                    {CoordinatePrecision::fine, "fine"},
                                    {CoordinatePrecision::exact, "exact"}};

Json json_of(const Character& character) {
  Json points = Json::array();
  for (const Point& point : character.structure.control_points) points.push_back({point.x(), point.y()});
  Json elements = Json::array();
  for (const ElementList composition : character.sequence.elements) elements.push_back(composition.elements());
  return {{"ids", character.sequence.stroke_ids}, {"elements", elements}, {"points", points}};
}

Character character_of(char32_t code, const Json& json) {
  std::vector<StrokeInput> strokes;
  std::size_t at = 0;
  for (std::size_t stroke = 0; stroke < json["ids"].size(); ++stroke) {
    strokes.push_back({json["ids"][stroke], {}, {}, json["elements"][stroke].get<std::string>()});
    for (int i = 0; i < control_point_count(strokes.back().elements); ++i, ++at) {
      strokes.back().control_points.emplace_back(json["points"][at][0], json["points"][at][1]);
    }
  }
  return make_character(code, strokes);
}

/// The characters, as a set file of each precision in a temporary directory and as the alternatives.
class Corpus {
 public:
  explicit Corpus(const std::string& path) {
    if (path.empty()) {
      list_ = built_in_characters();
    } else {
      const CharacterSet set = CharacterSet::open(path);
      list_.provenance = set.provenances().at(0);
      for (const StoredCharacter& character : set) list_.characters.push_back(character.character());
    }
    directory_ = std::filesystem::temp_directory_path() / ("calligraphy_" + std::to_string(std::random_device()()));
    std::filesystem::create_directory(directory_);
    for (const auto& [precision, name] : precisions) {
      const std::vector<std::byte> bytes = encode_character_set(list_, precision);
      write_file(directory_ / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    Random random(1);
    for (const Character& character : list_.characters) {
      map[character.code] = character;
      json[character.code] = json_of(character).dump();
      codes.push_back(character.code);
    }
    shuffle(codes, random);
  }
  Corpus(const Corpus&) = delete;
  Corpus& operator=(const Corpus&) = delete;
  ~Corpus() { std::filesystem::remove_all(directory_); }

  std::string path(CoordinatePrecision precision) const {
    return (directory_ / precisions[static_cast<int>(precision)].name).string();
  }

  std::unordered_map<char32_t, Character> map;
  std::unordered_map<char32_t, std::string> json;
  std::vector<char32_t> codes;  ///< in a random order

 private:
  CharacterList list_;
  std::filesystem::path directory_;
};

std::optional<Corpus> corpus;

/// One way to do the same work: its times per query [ns].
class Way {
 public:
  Way(std::string name, std::function<void(char32_t)> work) : name_(std::move(name)), work_(std::move(work)) {}

  /// Seconds for these queries.
  double time(const std::vector<char32_t>& codes) {
    const auto start = Clock::now();
    for (const char32_t code : codes) work_(code);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    times_.push_back(1e9 * seconds / static_cast<double>(codes.size()));
    return seconds;
  }
  double median() { return percentile(times_, 0.5); }
  void report(benchmark::State& state, const Way* reference) {
    state.counters[name_ + "_p50_ns"] = median();
    state.counters[name_ + "_p99_ns"] = percentile(times_, 0.99);
    if (reference != nullptr) state.counters[name_ + "_ratio"] = median() / const_cast<Way*>(reference)->median();
  }

 private:
  std::string name_;
  std::function<void(char32_t)> work_;
  std::vector<double> times_;
};

/// Rounds in which every way runs once on the same queries; the time of the first way is the iteration time.
void compare(benchmark::State& state, std::vector<Way> ways) {
  std::size_t next = 0;
  std::vector<char32_t> codes(queries_per_round);
  for (auto _ : state) {
    for (char32_t& code : codes) code = corpus->codes[next++ % corpus->codes.size()];
    state.SetIterationTime(ways.front().time(codes));
    for (std::size_t i = 1; i < ways.size(); ++i) ways[i].time(codes);
  }
  state.SetItemsProcessed(state.iterations() * queries_per_round);
  for (Way& way : ways) way.report(state, &way == &ways.front() ? nullptr : &ways.front());
}

void find(benchmark::State& state, CoordinatePrecision precision) {
  const CharacterSet set = CharacterSet::open(corpus->path(precision));
  const CharacterSet layered = CharacterSet::layered(std::vector{CharacterSet(built_in_characters()), set});
  set.check();
  compare(state, {{"set", [&](char32_t code) { benchmark::DoNotOptimize(set.find(code)); }},
                  {"absent", [&](char32_t code) { benchmark::DoNotOptimize(set.find(code + 0x80000)); }},
                  {"layered", [&](char32_t code) { benchmark::DoNotOptimize(layered.find(code)); }},
                  {"map", [&](char32_t code) { benchmark::DoNotOptimize(corpus->map.find(code)); }}});
}
BENCHMARK_CAPTURE(find, standard, CoordinatePrecision::standard)->UseManualTime();

void prepare(const Stroke& stroke) {
  const std::string_view kinds = stroke.elements;
  std::size_t at = 0;
  for (const char kind : kinds) {
    const std::size_t points = kind == static_cast<char>(ElementKind::line) ? 1 : 3;
    benchmark::DoNotOptimize(prepare_element(stroke.control_points.subspan(at, points + 1)));
    at += points;
  }
}

/// Index of a stroke of a character, a different one for each character.
int some_stroke(char32_t code, int count) { return static_cast<int>(code) % count; }

/// A character is looked up once, then its strokes are used one after the other: the cost of each of them.
void stroke(benchmark::State& state, CoordinatePrecision precision) {
  const CharacterSet set = CharacterSet::open(corpus->path(precision));
  std::unordered_map<char32_t, StoredCharacter> found;
  for (const char32_t code : corpus->codes) found[code] = *set.find(code);
  const auto of_set = [&](char32_t code) {
    const StoredCharacter& character = found.find(code)->second;
    return character.stroke(some_stroke(code, character.stroke_count()));
  };
  const auto ink_of_set = [&](char32_t code) {
    const StoredCharacter& character = found.find(code)->second;
    return character.ink(some_stroke(code, character.stroke_count()));
  };
  const auto of_map = [&](char32_t code) {
    const Character& character = corpus->map.find(code)->second;
    return strokes(character)[static_cast<std::size_t>(some_stroke(code, character.stroke_count()))];
  };
  compare(state, {{"prepared", [&](char32_t code) { prepare(of_set(code)->stroke()); }},
                  {"decoded", [&](char32_t code) { benchmark::DoNotOptimize(of_set(code)); }},
                  {"ink", [&](char32_t code) { benchmark::DoNotOptimize(ink_of_set(code)); }},
                  {"map_prepared", [&](char32_t code) { prepare(of_map(code)); }}});
}
BENCHMARK_CAPTURE(stroke, coarse, CoordinatePrecision::coarse)->UseManualTime();
BENCHMARK_CAPTURE(stroke, standard, CoordinatePrecision::standard)->UseManualTime();
BENCHMARK_CAPTURE(stroke, fine, CoordinatePrecision::fine)->UseManualTime();
BENCHMARK_CAPTURE(stroke, exact, CoordinatePrecision::exact)->UseManualTime();

/// A whole character, validated.
void character(benchmark::State& state, CoordinatePrecision precision) {
  const CharacterSet set = CharacterSet::open(corpus->path(precision));
  compare(state,
          {{"set", [&](char32_t code) { benchmark::DoNotOptimize(set.find(code)->character()); }},
           {"map_copy", [&](char32_t code) { benchmark::DoNotOptimize(Character(corpus->map.find(code)->second)); }},
           {"json", [&](char32_t code) {
              benchmark::DoNotOptimize(character_of(code, Json::parse(corpus->json.find(code)->second)));
            }}});
}
BENCHMARK_CAPTURE(character, standard, CoordinatePrecision::standard)->UseManualTime();

/// Looks up one character of each group, so that every checksum is verified.
void touch_every_group(const CharacterSet& set) {
  for (auto code = set.next(0); code; code = set.next((*code | 63) + 1)) benchmark::DoNotOptimize(set.find(*code));
}

/// `all`: as if every checksum were verified on opening.
void open(benchmark::State& state, CoordinatePrecision precision, bool all) {
  std::vector<double> times;
  for (auto _ : state) {
    const auto start = Clock::now();
    const CharacterSet set = CharacterSet::open(corpus->path(precision));
    if (all) touch_every_group(set);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    state.SetIterationTime(seconds);
    times.push_back(1e6 * seconds);
  }
  state.counters["p50_us"] = percentile(times, 0.5);
  state.counters["p99_us"] = percentile(times, 0.99);
}
BENCHMARK_CAPTURE(open, standard, CoordinatePrecision::standard, false)->UseManualTime();
BENCHMARK_CAPTURE(open, standard_all_checksums, CoordinatePrecision::standard, true)->UseManualTime();

/// The first use of a group: its checksum, and the pages that it occupies.
void first_find(benchmark::State& state, CoordinatePrecision precision) {
  std::vector<double> times;
  for (auto _ : state) {
    const CharacterSet set = CharacterSet::open(corpus->path(precision));
    for (auto code = set.next(0); code; code = set.next((*code | 63) + 1)) {
      const auto start = Clock::now();
      benchmark::DoNotOptimize(set.find(*code));
      times.push_back(nanoseconds(Clock::now() - start));
    }
  }
  state.counters["p50_ns"] = percentile(times, 0.5);
  state.counters["p99_ns"] = percentile(times, 0.99);
  state.counters["max_ns"] = times.back();
}
BENCHMARK_CAPTURE(first_find, standard, CoordinatePrecision::standard);

/// Distances between original and stored strokes, at points of equal parameter [em].
struct ShapeError {
  double largest = 0.0;
  double squares = 0.0;
  double points = 0.0;

  void add(const Stroke& drawn, const Stroke& kept) {
    constexpr int steps = 16;
    const Placement em_square{Point::Zero(), 1.0};
    const auto before = place_elements(drawn, em_square), after = place_elements(kept, em_square);
    for (std::size_t element = 0; element < before.size(); ++element) {
      for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double distance = (before[element].point(t) - after[element].point(t)).norm();
        largest = std::max(largest, distance);
        squares += distance * distance;
        points += 1.0;
      }
    }
  }
  double rms() const { return std::sqrt(squares / points); }
};

ShapeError shape_error(const CharacterSet& set) {
  ShapeError error;
  for (const auto& [code, drawn] : corpus->map) {
    const Character kept = set.find(code)->character();
    const std::vector<Stroke> before = strokes(drawn), after = strokes(kept);
    for (std::size_t i = 0; i < before.size(); ++i) error.add(before[i], after[i]);
  }
  return error;
}

/// Not a time: sizes and accuracy.
void size(benchmark::State& state, CoordinatePrecision precision) {
  const CharacterSet set = CharacterSet::open(corpus->path(precision));
  for (auto _ : state) benchmark::DoNotOptimize(set.bytes());
  const ShapeError error = shape_error(set);
  state.counters["characters"] = static_cast<double>(set.size());
  state.counters["bytes"] = static_cast<double>(set.bytes());
  state.counters["bytes_each"] = static_cast<double>(set.bytes()) / static_cast<double>(set.size());
  state.counters["point_error_em"] = set.coordinate_error();
  state.counters["shape_error_em"] = error.largest;
  state.counters["shape_rms_em"] = error.rms();
}
BENCHMARK_CAPTURE(size, coarse, CoordinatePrecision::coarse)->Iterations(1);
BENCHMARK_CAPTURE(size, standard, CoordinatePrecision::standard)->Iterations(1);
BENCHMARK_CAPTURE(size, fine, CoordinatePrecision::fine)->Iterations(1);
BENCHMARK_CAPTURE(size, exact, CoordinatePrecision::exact)->Iterations(1);

/// Not a time: growth of the mapping with the number of characters used, from a file not read before.
void resident(benchmark::State& state, CoordinatePrecision precision) {
  const std::string path = corpus->path(precision);
  forget_content(path);
  const CharacterSet set = CharacterSet::open(path);
  for (auto _ : state) benchmark::DoNotOptimize(set.bytes());
  const auto kibibytes = [&] { return static_cast<double>(resident_bytes(path).value_or(0)) / 1024.0; };
  state.counters["file_KiB"] = static_cast<double>(set.bytes()) / 1024.0;
  state.counters["opened_KiB"] = kibibytes();
  std::size_t used = 0;
  for (const std::size_t count : {1, 10, 100, 1000, 10000}) {
    for (; used < std::min(count, corpus->codes.size()); ++used) {
      benchmark::DoNotOptimize(set.find(corpus->codes[used])->stroke(0));
    }
    state.counters["used_" + std::to_string(count) + "_KiB"] = kibibytes();
  }
}
BENCHMARK_CAPTURE(resident, standard, CoordinatePrecision::standard)->Iterations(1);
BENCHMARK_CAPTURE(resident, exact, CoordinatePrecision::exact)->Iterations(1);

/// Not a time: memory used by the alternatives.
void alternatives(benchmark::State& state) {
  std::size_t json = 0, map = 0;
  for (auto _ : state) benchmark::DoNotOptimize(json);
  for (const auto& [code, text] : corpus->json) json += text.size();
  for (const auto& [code, drawn] : corpus->map) {
    map += sizeof(std::pair<const char32_t, Character>) + 2 * sizeof(void*) +
           drawn.structure.control_points.capacity() * sizeof(Point) +
           (drawn.sequence.stroke_ids.capacity() + drawn.sequence.feature_points.capacity()) * sizeof(int) +
           drawn.sequence.elements.capacity() * sizeof(ElementList) +
           drawn.physics.attraction_factors.capacity() * sizeof(double);
  }
  const auto count = static_cast<double>(corpus->map.size());
  state.counters["json_bytes_each"] = static_cast<double>(json) / count;
  state.counters["map_bytes_each"] = static_cast<double>(map) / count;
}
BENCHMARK(alternatives)->Iterations(1);

}  // namespace

int main(int argc, char** argv) {
  try {
    benchmark::Initialize(&argc, argv);
    if (argc > 2) throw Error("usage: benchmark_character_set [FILE] [--benchmark_...]");
    corpus.emplace(argc == 2 ? argv[1] : "");
    benchmark::RunSpecifiedBenchmarks();
    corpus.reset();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "benchmark_character_set: " << error.what() << '\n';
    return 1;
  }
}
