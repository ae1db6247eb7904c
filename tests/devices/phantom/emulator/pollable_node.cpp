#include "pollable_node.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace calligraphy_test {
namespace {

constexpr int one_page = 4096;

}  // namespace

PollableNode::PollableNode(std::string path) : path_(std::move(path)), descriptor_(-1) {
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path());
  if (mkfifo(path_.c_str(), 0666) == 0) descriptor_ = open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) throw std::runtime_error(path_ + ": no FIFO: " + std::strerror(errno));
  if (fcntl(descriptor_, F_SETPIPE_SZ, one_page) != one_page) {
    close(descriptor_);
    throw std::runtime_error(path_ + ": a FIFO of one page is not possible: " + std::strerror(errno));
  }
}

PollableNode::~PollableNode() {
  unlink(path_.c_str());
  close(descriptor_);
}

void PollableNode::set_filled(bool filled) noexcept {
  if (filled == filled_) return;
  filled_ = filled;
  char byte = 0;
  if (filled) {
    syscall(SYS_write, descriptor_, &byte, 1);
  } else {
    syscall(SYS_read, descriptor_, &byte, 1);
  }
}

}  // namespace calligraphy_test
