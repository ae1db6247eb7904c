#include "table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>

namespace nearest_point_benchmark {
namespace {

using Measurements = std::span<const Measurement>;

std::vector<std::string> distinct(Measurements results, std::string Measurement::*name) {
  std::vector<std::string> names;
  for (const Measurement& each : results) {
    if (std::find(names.begin(), names.end(), each.*name) == names.end()) names.push_back(each.*name);
  }
  return names;
}

const Measurement* find(Measurements results, const std::string& workload, const std::string& method) {
  const auto found = std::find_if(results.begin(), results.end(), [&](const Measurement& each) {
    return each.workload == workload && each.method == method;
  });
  return found == results.end() ? nullptr : &*found;
}

/// Geometric mean of the medians of one method over the workloads for which `counts`.
double geometric_mean(Measurements results, const std::string& method,
                      const std::function<bool(const std::string&)>& counts) {
  double sum = 0.0, count = 0.0;
  for (const Measurement& each : results) {
    if (each.method != method || !counts(each.workload)) continue;
    sum += std::log(each.nanoseconds.p50);
    count += 1.0;
  }
  return std::exp(sum / count);
}

bool any(const std::string&) { return true; }
bool real(const std::string& workload) { return workload.starts_with("real strokes"); }

std::string time(const Measurement* measurement) {
  return measurement == nullptr ? "" : fmt::format("{:.1f}", measurement->nanoseconds.p50);
}

/// Target for the time of `exact` (or the tracker) relative to this method.
struct Mark {
  const char* method;
  double all, real;
};
constexpr Mark marks[] = {{"paper, plain 1e-6", 0.30, 0.14}, {"kurbo nearest 1e-12", 0.18, 0.12}};
constexpr double stroke_mark = 0.06;

const Mark* mark_for(const std::string& method) {
  const auto* found =
      std::find_if(std::begin(marks), std::end(marks), [&](const Mark& mark) { return method == mark.method; });
  return found == std::end(marks) ? nullptr : found;
}

std::string judged(double ratio, std::optional<double> mark) {
  if (!mark) return fmt::format("{:.3f}", ratio);
  return fmt::format("{:.3f} (target {:.2f}: {})", ratio, *mark, ratio <= *mark ? "met" : "MISSED");
}

}  // namespace

void print_workloads(std::FILE* out, Measurements results) {
  const auto methods = distinct(results, &Measurement::method);
  const auto workloads = distinct(results, &Measurement::workload);
  fmt::print(
      out,
      "\n## Nearest point, ns per query: medians of rounds, and their geometric mean\n\n"
      "Errors are errors of the distance, relative to the size. Maximum: where 1e-9 is attainable. Beyond: off by more "
      "than\nthe workload permits; wrong: by more than 1e-3; both on the worst workload.\n\n");
  fmt::print(out, "| {:<22} | {:>10} | {:>10} | {:>10} | {:>7} | {:>9} | {:>7} | {:<20} | {:>7} | {:>7} | {:<20} |\n",
             "method", "real, near", "real, box", "random box", "hook", fmt::format("geo. of {}", workloads.size()),
             "maximum", "  on", "beyond", "wrong", "  on");
  fmt::print(out, "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& method : methods) {
    Errors worst;
    std::string worst_on, wrong_on;
    for (const Measurement& each : results) {
      if (each.method != method) continue;
      if (each.allowed <= 1e-9 && each.errors.largest > worst.largest) {
        worst.largest = each.errors.largest;
        worst_on = each.workload;
      }
      if (each.errors.wrong > worst.wrong) {
        worst.wrong = each.errors.wrong;
        wrong_on = each.workload;
      }
      worst.beyond = std::max(worst.beyond, each.errors.beyond);
    }
    fmt::print(out,
               "| {:<22} | {:>10} | {:>10} | {:>10} | {:>7} | {:>9.1f} | {:>7.1e} | {:<20} | {:>5.1f} % | {:>5.1f} % | "
               "{:<20} |\n",
               method, time(find(results, "real strokes near", method)),
               time(find(results, "real strokes box", method)), time(find(results, "random box", method)),
               time(find(results, "hook", method)), geometric_mean(results, method, any), worst.largest, worst_on,
               100.0 * worst.beyond, 100.0 * worst.wrong, wrong_on);
  }
  if (std::find(methods.begin(), methods.end(), "exact") == methods.end()) return;
  fmt::print(out,
             "\n## Time of `exact` relative to each, geometric means\n\n| of | all workloads | real strokes "
             "|\n|---|---|---|\n");
  for (const std::string& method : methods) {
    if (method == "exact") continue;
    const Mark* mark = mark_for(method);
    const auto share = [&](const auto& counts) {
      return geometric_mean(results, "exact", counts) / geometric_mean(results, method, counts);
    };
    fmt::print(out, "| {} | {} | {} |\n", method, judged(share(any), mark ? std::optional(mark->all) : std::nullopt),
               judged(share(real), mark ? std::optional(mark->real) : std::nullopt));
  }
}

void print_details(std::FILE* out, Measurements results) {
  const auto methods = distinct(results, &Measurement::method);
  fmt::print(
      out, "\n## Every workload, ns per query: p50 (p10 to p90 of the rounds); beyond: off by more than permitted\n\n");
  for (const std::string& workload : distinct(results, &Measurement::workload)) {
    fmt::print(out, "{}\n", workload);
    for (const std::string& method : methods) {
      const Measurement* each = find(results, workload, method);
      if (each == nullptr) continue;
      fmt::print(out, "  {:<22} {:>9.1f} ({:.1f} to {:.1f})  maximum error {:.1e}, wrong {:.2f} %, beyond {:.2f} %\n",
                 method, each->nanoseconds.p50, each->nanoseconds.p10, each->nanoseconds.p90, each->errors.largest,
                 100.0 * each->errors.wrong, 100.0 * each->errors.beyond);
    }
  }
}

void print_strokes(std::FILE* out, Measurements results) {
  for (const std::string& set : distinct(results, &Measurement::workload)) {
    const Measurement* tracker = find(results, set, "StrokeTracker");
    fmt::print(out, "\n## Whole {} at 1 kHz, ns per tick\n\n", set);
    fmt::print(
        out, "| {:<22} | {:>8} | {:>17} | {:>9} | {:>7} | StrokeTracker relative to it |\n|---|---|---|---|---|---|\n",
        "method", "p50", "p10 to p90", "maximum", "wrong");
    for (const Measurement& each : results) {
      if (each.workload != set) continue;
      std::string share;
      if (tracker != nullptr && tracker != &each) {
        const bool marked = each.method == "paper, plain 1e-6";
        share =
            judged(tracker->nanoseconds.p50 / each.nanoseconds.p50, marked ? std::optional(stroke_mark) : std::nullopt);
      }
      fmt::print(out, "| {:<22} | {:>8.1f} | {:>7.1f} to {:>6.1f} | {:>9.1e} | {:>5.2f} % | {} |\n", each.method,
                 each.nanoseconds.p50, each.nanoseconds.p10, each.nanoseconds.p90, each.errors.largest,
                 100.0 * each.errors.wrong, share);
    }
  }
}

void print_swept(std::FILE* out, Measurements results) {
  fmt::print(out, "\n## Out of the caches, ns per query: p50 (p10 to p90)\n\n");
  for (const std::string& workload : distinct(results, &Measurement::workload)) {
    fmt::print(out, "{}\n", workload);
    for (const Measurement& each : results) {
      if (each.workload != workload) continue;
      fmt::print(out, "  {:<22} {:>9.1f} ({:.1f} to {:.1f})\n", each.method, each.nanoseconds.p50, each.nanoseconds.p10,
                 each.nanoseconds.p90);
    }
  }
}

void print_calls(std::FILE* out, std::span<const CallTimes> results) {
  fmt::print(out,
             "\n## Single calls near real strokes, ns, including the clock: over all calls | over the medians of each "
             "query\n\n");
  fmt::print(out, "| {:<22} | {:>6} | {:>6} | {:>7} | {:>6} | {:>6} | {:>6} |\n|---|---|---|---|---|---|---|\n",
             "method", "p50", "p99", "p99.9", "p50", "p99", "p99.9");
  for (const CallTimes& each : results) {
    fmt::print(out, "| {:<22} | {:>6.0f} | {:>6.0f} | {:>7.0f} | {:>6.0f} | {:>6.0f} | {:>6.0f} |\n", each.method,
               each.p50, each.p99, each.p999, each.steady_p50, each.steady_p99, each.steady_p999);
  }
}

void print_elements(std::FILE* out, std::span<const ElementCost> results) {
  fmt::print(out, "\n## Preparing an element\n\n| kind | ns, p50 | p10 to p90 | bytes |\n|---|---|---|---|\n");
  for (const ElementCost& each : results) {
    fmt::print(out, "| {} | {:.0f} | {:.0f} to {:.0f} | {} |\n", each.kind, each.nanoseconds.p50, each.nanoseconds.p10,
               each.nanoseconds.p90, each.bytes);
  }
}

}  // namespace nearest_point_benchmark
