// What people are told of a stroke or a pen-down.
#pragma once

#include <string>

#include <calligraphy/model/character.hpp>
#include <calligraphy/practice/stroke_matching.hpp>

#include "stroke_reading.hpp"

namespace calligraphy {

/// The sentences for the remarks on one reading.
class RemarkWords {
 public:
  RemarkWords(const Character& character, const MatchResult& match, const StrokeReading& reading);

  std::string order(int path) const;
  std::string backwards(int path) const;
  std::string other_shape(int path) const;
  std::string joined(int path) const;
  std::string broken(int path) const;
  std::string extra(int path) const;

 private:
  std::string stroke(int index) const;

  const std::vector<Stroke> strokes_;
  const MatchResult& match_;
  const StrokeReading& reading_;
};

}  // namespace calligraphy
