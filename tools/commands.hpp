// The commands of the program: each registers itself with its options and does its work when it was asked for.
#pragma once

#include <calligraphy/base/error.hpp>

namespace CLI {
class App;
}

namespace calligraphy::tools {

/// A command line that cannot be done: the program ends with 2, not 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

void add_write(CLI::App& program);
void add_strokes(CLI::App& program);
void add_info(CLI::App& program);
void add_trade(CLI::App& program);
void add_stability(CLI::App& program);
void add_import(CLI::App& program);
void add_validate(CLI::App& program);
void add_replay(CLI::App& program);
void add_devices(CLI::App& program);

}  // namespace calligraphy::tools
