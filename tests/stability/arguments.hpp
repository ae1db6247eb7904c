// Arguments of the programs that judge stability: "--name value" and "--flag".
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

namespace calligraphy_test {

class Arguments {
 public:
  Arguments(int argc, char** argv) : given_(argv + 1, argv + argc) {}

  bool flag(const std::string& name) {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      if (given_[i] != name) continue;
      given_.erase(given_.begin() + static_cast<std::ptrdiff_t>(i));
      return true;
    }
    return false;
  }
  std::string text(const std::string& name, const std::string& otherwise = "") {
    for (std::size_t i = 0; i + 1 < given_.size(); ++i) {
      if (given_[i] != name) continue;
      const std::string value = given_[i + 1];
      given_.erase(given_.begin() + static_cast<std::ptrdiff_t>(i),
                   given_.begin() + static_cast<std::ptrdiff_t>(i + 2));
      return value;
    }
    return otherwise;
  }
  double number(const std::string& name, double otherwise) {
    const std::string value = text(name);
    if (value.empty()) return otherwise;
    char* end = nullptr;
    const double result = std::strtod(value.c_str(), &end);
    if (*end != '\0') wrong_ = true;
    return result;
  }
  /// Nothing is left over, and every number was one.
  bool understood() const { return given_.empty() && !wrong_; }

 private:
  std::vector<std::string> given_;
  bool wrong_ = false;
};

}  // namespace calligraphy_test
