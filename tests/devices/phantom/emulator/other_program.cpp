#include "other_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <stdexcept>

namespace calligraphy_test {
namespace {

constexpr int max_answer = 60'000;  // [ms]

}  // namespace

OtherProgram::OtherProgram(const std::string& test_case) {
  int to[2], from[2];
  if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  to_ = to[1];
  from_ = from[0];
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::string arguments[] = {program, test_case};
  char* const list[] = {arguments[0].data(), arguments[1].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from[1], STDOUT_FILENO);
  const int error = posix_spawn(&process_, program.c_str(), &actions, nullptr, list, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(to[0]);
  close(from[1]);
  if (error != 0) throw std::runtime_error(program + " cannot be started");
}

OtherProgram::~OtherProgram() {
  if (process_ != 0) kill();
  close(to_);
  close(from_);
}

std::string OtherProgram::heard() {
  std::string line;
  while (true) {
    pollfd waiting{from_, POLLIN, 0};
    char letter = 0;
    if (poll(&waiting, 1, max_answer) != 1 || read(from_, &letter, 1) != 1) return line + " (and no more)";
    if (letter == '\n') return line;
    line += letter;
  }
}

void OtherProgram::end() {
  const char letter = '\n';
  if (write(to_, &letter, 1) != 1) throw std::runtime_error("the other program hears nothing");
  wait();
}

void OtherProgram::kill() {
  ::kill(process_, SIGKILL);
  wait();
}

void OtherProgram::wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = 0;
}

void say(const std::string& line) {
  const std::string text = line + "\n";
  if (write(STDOUT_FILENO, text.data(), text.size()) < 0) throw std::runtime_error("nobody hears this program");
}

void wait_for_the_end() {
  char letter = 0;
  [[maybe_unused]] const ssize_t got = read(STDIN_FILENO, &letter, 1);  // 0 if the test has exited: ends as well
}

}  // namespace calligraphy_test
