// emulated_phantom: runs a command on an emulated Phantom, which a simulated hand holds (docs/emulated-phantom.md).
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "emulated_phantom.hpp"
#include "hand_motion.hpp"

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>

#include "writing_hand.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

constexpr char model[] = "touch";
constexpr double push_at_signal = 0.2;  // [N]

constexpr char usage[] =
    "usage: emulated_phantom [--kind usb|hid] [--serial NUMBER] [--write TEXT] [--characters SET] [--skill "
    "novice|skilled]\n"
    "                        [--seed N] [--signal N] -- COMMAND...\n";

struct Options {
  bool hid = false;
  std::string serial = "540-00001";
  std::string text;        ///< empty: the hand goes in circles
  std::string characters;  ///< a set file; empty: the built-in set
  bool skilled = false;
  std::uint64_t seed = 1;
  int signal = 0;  ///< sent to the command once its force is above `push_at_signal`; 0: none
  std::vector<char*> command;
};

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Options options_of(int argc, char** argv) {
  Options options;
  int i = 1;
  for (; i < argc && std::string(argv[i]) != "--"; i += 2) {
    const std::string name = argv[i];
    if (name == "--help" || name == "-h") {
      std::cout << usage;
      std::exit(0);
    }
    if (i + 1 >= argc) throw UsageError(name + ": a value is missing");
    const std::string value = argv[i + 1];
    if (name == "--kind" && (value == "usb" || value == "hid")) {
      options.hid = value == "hid";
    } else if (name == "--serial") {
      options.serial = value;
    } else if (name == "--write") {
      options.text = value;
    } else if (name == "--characters") {
      options.characters = value;
    } else if (name == "--skill" && (value == "novice" || value == "skilled")) {
      options.skilled = value == "skilled";
    } else if (name == "--seed") {
      options.seed = std::stoull(value);
    } else if (name == "--signal") {
      options.signal = std::stoi(value);
    } else {
      throw UsageError(name + " " + value + ": not understood");
    }
  }
  for (++i; i < argc; ++i) options.command.push_back(argv[i]);
  if (options.command.empty()) throw UsageError("a command is missing after --");
  options.command.push_back(nullptr);
  return options;
}

WriterSkill skill_of(const Options& options) {
  return options.skilled ? WriterSkill::skilled() : WriterSkill::novice();
}

GripImpedance grip_of_skill(const Options& options) { return skill_of(options).grip; }

std::unique_ptr<HandMotion> hand_of(const Options& options) {
  if (options.text.empty()) return std::make_unique<CirclingHand>();
  const CharacterSet set =
      options.characters.empty() ? CharacterSet(built_in_characters()) : CharacterSet::open(options.characters);
  const Capabilities& capabilities = device_profile(model);
  return std::make_unique<WritingHand>(page_to_write(options.text, set, capabilities), capabilities, skill_of(options),
                                       options.seed);
}

/// Phase of a run.
enum class Stage { docked, carried, resting, moving };

/// Steps the device and its hand by 1 ms: the pen stays in the inkwell until a program has sent commands for
/// a while, is carried to the start of the motion, and then moves.
class Run {
 public:
  Run(const Options& options, HandMotion& hand)
      : phantom_(bed_, options.hid ? hid_touch(options.serial) : serial_touch(options.serial), grip_of_skill(options),
                 model),
        hand_(hand) {
    phantom_.bus.plug_in(1, "2");
  }

  void step() {
    SimulatedDevice& tip = phantom_.arm.tip;
    if (stage_ == Stage::docked && phantom_.bus.packets_taken() > 0 && ++waited_ > docked_for) {
      phantom_.arm.docked = false;
      tip.set_intention({tip.true_position(), hand_.start() - tip.true_position()});
      next(Stage::carried);
    } else if (stage_ == Stage::carried && ++waited_ > carried_for) {
      phantom_.arm.move_hand(hand_.start());
      next(Stage::resting);
    } else if (stage_ == Stage::resting && ++waited_ > resting_for) {
      next(Stage::moving);
    }
    if (stage_ == Stage::moving) tip.set_intention(hand_.next(tip.true_position(), 1e-3));
    phantom_.step();
  }

  /// Of the command that the device received last, its own watchdog aside [N].
  double commanded_force() { return phantom_.commanded_force().norm(); }

  std::uint64_t reports() const { return phantom_.pushed; }
  std::uint64_t commands() const { return phantom_.bus.packets_taken(); }

 private:
  static constexpr int docked_for = 200;    // [ms]
  static constexpr int carried_for = 1000;  // [ms]
  static constexpr int resting_for = 500;   // [ms]

  void next(Stage stage) {
    stage_ = stage;
    waited_ = 0;
  }

  TestBed bed_;
  EmulatedPhantom phantom_;
  HandMotion& hand_;
  Stage stage_ = Stage::docked;
  int waited_ = 0;
};

pid_t started(const Options& options) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process could be started");
  if (child == 0) {
    std::signal(SIGPIPE, SIG_DFL);
    execvp(options.command.front(), options.command.data());
    std::perror(options.command.front());
    _exit(127);
  }
  return child;
}

/// Runs at 1 kHz until the command has ended. After a pause of the machine the overdue steps follow immediately, a few
/// at a time: a device does not wait.
int run_beside(Run& run, pid_t child, int signal) {
  constexpr long period = 1'000'000;  // [ns]
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    run.step();
    if (signal != 0 && run.commanded_force() > push_at_signal) kill(child, std::exchange(signal, 0));
    due.tv_nsec += period;
    if (due.tv_nsec >= 1'000'000'000) {
      due.tv_nsec -= 1'000'000'000;
      ++due.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = options_of(argc, argv);
  if (!in_test_bed()) {
    std::vector<char*> again{const_cast<char*>("umockdev-wrapper")};
    again.insert(again.end(), argv, argv + argc + 1);
    execvp(again.front(), again.data());
    std::cerr << "emulated_phantom: umockdev-wrapper cannot be run: install umockdev\n";
    return 77;
  }
  prctl(PR_SET_TIMERSLACK, 1);  // otherwise every answer of the test bed is delayed by 50 us
  setenv("CALLIGRAPHY_WIRE_PROFILE", "simulated", 0);
  const std::unique_ptr<HandMotion> hand = hand_of(options);
  Run run(options, *hand);
  const pid_t child = started(options);
  signal(SIGINT, SIG_IGN);  // handled by the command, whose exit ends this program
  const int status = run_beside(run, child, options.signal);
  std::cerr << "emulated_phantom: " << run.reports() << " reports sent, " << run.commands()
            << " commands taken, the last for " << run.commanded_force() << " N\n";
  return status;
} catch (const UsageError& error) {
  std::cerr << "emulated_phantom: " << error.what() << "\n" << usage;
  return 2;
} catch (const std::exception& error) {
  std::cerr << "emulated_phantom: " << error.what() << "\n";
  return 1;
}
