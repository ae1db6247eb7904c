// Another program on the same test bed: this one, started a second time to do what one hidden test case says.
#pragma once

#include <string>

#include <sys/types.h>

namespace calligraphy_test {

class OtherProgram {
 public:
  /// Runs the test case of that name in a process of its own.
  explicit OtherProgram(const std::string& test_case);
  /// Kills it when it still runs.
  ~OtherProgram();
  OtherProgram(const OtherProgram&) = delete;
  OtherProgram& operator=(const OtherProgram&) = delete;

  /// The next line that it has said, waited for at most ten seconds.
  std::string heard();
  /// Lets it end, and waits for that.
  void end();
  /// As kill -9 does, and waits for it.
  void kill();

 private:
  void wait();

  pid_t process_ = 0;
  int to_ = -1, from_ = -1;
};

/// Of the other program: says a line.
void say(const std::string& line);
/// Of the other program: until it is told to end.
void wait_for_the_end();

}  // namespace calligraphy_test
