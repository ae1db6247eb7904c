// The commands of the program. Each registers itself with its options and runs when selected.
#pragma once

#include <calligraphy/base/error.hpp>

namespace CLI {
class App;
}

namespace calligraphy::tools {

/// An invalid command line: the program exits with code 2 instead of 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

void add_write(CLI::App& program);
void add_strokes(CLI::App& program);
void add_info(CLI::App& program);
void add_tradeoff(CLI::App& program);
void add_stability(CLI::App& program);
void add_import(CLI::App& program);
void add_traces(CLI::App& program);
void add_validate(CLI::App& program);
void add_replay(CLI::App& program);
void add_devices(CLI::App& program);
void add_help(CLI::App& program);
void add_completion(CLI::App& program);

}  // namespace calligraphy::tools
