// Another program on the same test bed: this program, started again to run one hidden test case.
#pragma once

#include <string>

#include <sys/types.h>

namespace calligraphy_test {

class OtherProgram {
 public:
  /// Runs the test case of that name in its own process.
  explicit OtherProgram(const std::string& test_case);
  /// Kills it if it is still running.
  ~OtherProgram();
  OtherProgram(const OtherProgram&) = delete;
  OtherProgram& operator=(const OtherProgram&) = delete;

  /// Waits at most ten seconds for its next line of output.
  std::string heard();
  /// Tells it to end and waits for that.
  void end();
  /// Kills it as kill -9 does, and waits for that.
  void kill();

 private:
  void wait();

  pid_t process_ = 0;
  int to_ = -1, from_ = -1;
};

/// For the other program: writes a line.
void say(const std::string& line);
/// For the other program: waits until it is told to end.
void wait_for_the_end();

}  // namespace calligraphy_test
