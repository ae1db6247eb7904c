// Starting another program; the only place in this component that knows the operating system.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace calligraphy {

struct ProcessResult {
  int exit_code = 0;   ///< 128 + signal when a signal ended it
  std::string output;  ///< what it wrote to its standard output
  std::string errors;  ///< what it wrote to its standard error
};

/// Runs a program found on the search path, without a shell, and waits for it. Its input and outputs go through files:
/// neither side can block the other, and one that ends early breaks no pipe.
/// @throws Error naming the program and the reason when it cannot be started
ProcessResult run_process(const std::vector<std::string>& command, std::string_view input);

}  // namespace calligraphy
