#include "bezier_js.hpp"

#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>

#include "pictures/process.hpp"

namespace nearest_point_benchmark {
namespace {

/// A temporary directory, removed with this object.
class ScratchDirectory {
 public:
  ScratchDirectory()
      : path_(std::filesystem::temp_directory_path() /
              ("calligraphy-bezier-js-" + std::to_string(std::random_device()()))) {
    std::filesystem::create_directory(path_);
  }
  ~ScratchDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  std::filesystem::path file(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

nlohmann::json numbers(std::span<const Point> points) {
  nlohmann::json list = nlohmann::json::array();
  for (const Point& point : points) {
    list.push_back(point.x());
    list.push_back(point.y());
  }
  return list;
}

/// JSON has no NaN: null.
double number(const nlohmann::json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

BezierJsRun run_bezier_js(const std::string& package, std::span<const calligraphy::CurveQueries> curves, int rounds) {
  const ScratchDirectory scratch;
  nlohmann::json input{{"rounds", rounds}, {"curves", nlohmann::json::array()}};
  for (const auto& curve : curves) {
    input["curves"].push_back({{"control_points", numbers(curve.control_points)}, {"queries", numbers(curve.queries)}});
  }
  std::ofstream(scratch.file("queries.json")) << input;
  const calligraphy::ProcessResult result = calligraphy::run_process(
      {"node", CALLIGRAPHY_BEZIER_JS_SCRIPT, package, scratch.file("queries.json"), scratch.file("answers.json")}, "");
  if (result.exit_code != 0) throw calligraphy::Error("bezier.js: " + result.errors);

  const auto output = nlohmann::json::parse(std::ifstream(scratch.file("answers.json")));
  BezierJsRun run{output.at("nanoseconds"), {}};
  const auto& answers = output.at("answers");
  for (std::size_t i = 0; i + 3 < answers.size(); i += 4) {
    run.answers.push_back(
        {number(answers[i]), {number(answers[i + 1]), number(answers[i + 2])}, number(answers[i + 3])});
  }
  return run;
}

}  // namespace nearest_point_benchmark
