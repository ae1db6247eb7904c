"""The generator of documentation, fields and members from C++ headers."""

import importlib.util
import pathlib
import re
import sys

import pytest

spec = importlib.util.spec_from_file_location("make_docs", pathlib.Path(__file__).parents[1] / "make_docs.py")
make_docs = sys.modules["make_docs"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(make_docs)

HEADER = r"""
// Not documentation. struct Nowhere { int never; };
#include <string>
namespace calligraphy {

/// What a pen does; bit flags.
enum class Mark : std::uint16_t {
  none = 0,
  down = 1 << 0,  ///< it touches the paper
  up = 1 << 1     ///< it does not,
                  ///< or no longer
};
/* struct Comment { int never; }; */
constexpr Mark operator|(Mark a, Mark b) noexcept { return static_cast<Mark>(int(a) | int(b)); }
constexpr Mark& operator|=(Mark& a, Mark b) noexcept { return a = a | b; }

/// Where a stroke goes.
///
/// A second paragraph about Mark::down,
/// in two lines.
struct Way {
  int count = 1'000'000;  ///< how many
  /// Above: with `true`, "quotes" and std::nullopt.
  double length = 0.5, width{0.25};
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< of the tip [m]
  std::vector<Mark> marks = {Mark::down, Mark::up};
  std::optional<Mark> mark;               ///< the last one
  std::array<double, 4> knots = {};       ///< shares. Increasing.
  std::function<void(double)> progress = nullptr;  ///< called from time to time
  double (*clock)() noexcept = nullptr;   ///< also a function
  Watch watch;                            ///< a function under another name
  const char* name = "};";                ///< a pointer
  static constexpr int limit = 3;         ///< of the class

  bool operator==(const Way&) const = default;
  /// Whether it is empty. @throws ValueError if it has {no} end
  bool empty() const noexcept { return count == 0; }
  /// @return the tip [m]
  Eigen::Vector3d tip() const;
  const Way* find(int index, std::string_view order = {}) const noexcept;  ///< false: the first; nullptr if there is none

 private:
  struct Hidden { int never; };
  int hidden = 0;  ///< never
};
using Watch = std::function<bool(const Way&)>;

/// A class.
class Pen final : public Device {
  int never_ = 0;

 public:
  /// Makes one.
  explicit Pen(Way way) : way_{std::move(way)}, count_(1) {}
  ~Pen() override;
  Pen(const Pen&) = delete;

  /// What it shows.
  struct View {
    int tick = 0;  ///< the last
  };

  /// Moves it; throws nothing.
  void move(const Way& way, int times = 1);

 private:
  Way way_;
};

namespace detail {
/// Internal.
int secret();
}  // namespace detail

namespace phantom {
/// In a namespace of its own. Uses phantom::linkage() and Way::tip().
[[nodiscard]] inline double linked(const Way& way) {
  if (way.count > 0) { return 1.0; }
  return '}' == '{' ? 0.0 : 2.0;
}
}  // namespace phantom

/// Does something
/// @param way where
/// @throws ValueError when it cannot, FileError otherwise
/// @return what was done
template <class Type>
std::vector<int> act(const Way& way);
inline double Pen::elsewhere() { return 0.0; }
}  // namespace calligraphy
"""


@pytest.fixture(scope="module")
def text():
    return make_docs.generated({"calligraphy/way.hpp": HEADER})


def told(text):
    return {f"{o}::{n}".removeprefix("::"): t for o, n, t in re.findall(r'^    \{"(.*?)", "(.*?)", "(.*)"\},$', text, re.M)}


def test_names_are_those_of_the_public_declarations(text):
    assert set(told(text)) == {
        "Mark", "Way", "Way::count", "Way::length", "Way::width", "Way::place", "Way::marks", "Way::mark", "Way::knots",
        "Way::progress", "Way::watch", "Way::name", "Way::empty", "Way::tip", "Way::find", "Pen", "Pen::Pen", "Pen::~Pen",
        "Pen::View", "Pen::View::tick", "Pen::move", "linked", "act",
    }  # fmt: skip


def test_fields_are_those_that_python_can_have_in_order(text):
    assert re.findall(r'Field\{&::calligraphy::Way::(\w+), "(\w+)"\}', text) == [
        (name, name) for name in ("count", "length", "width", "place", "marks", "mark", "knots")
    ]
    assert re.findall(r'Field\{&(\S+), "tick"\}', text) == ["::calligraphy::Pen::View::tick"]


def test_members_of_flags_leave_out_none(text):
    assert re.findall(r'Member\{::calligraphy::Mark::(\w+), "\w+", "(.*?)"\}', text) == [
        ("down", "it touches the paper"),
        ("up", "it does not, or no longer"),
    ]
    assert "is_flags<::calligraphy::Mark> = true" in text


@pytest.mark.parametrize(
    "name, expected",
    {
        "Way": r"Where a stroke goes.\n\nA second paragraph about Mark.down, in two lines.",
        "Way::count": "how many",
        "Way::length": r"Above: with `True`, \"quotes\" and None.",
        "Way::width": r"Above: with `True`, \"quotes\" and None.",
        "Way::place": "of the tip, (3,) [m]",
        "Way::marks": "list of Mark; copied",
        "Way::mark": "Mark or None: the last one",
        "Way::knots": "shares. Increasing. (4,).",
        "Way::empty": "Whether it is empty. Raises InvalidValue if it has {no} end.",
        "Way::tip": "Returns the tip [m]. (3,).",
        "Way::find": "False: the first; None if there is none",
        "Pen::move": "Moves it; raises nothing.",
        "linked": "In a namespace of its own. Uses linkage() and Way.tip().",
        "act": "Does something. `way`: where. Raises InvalidValue when it cannot, FileError otherwise. Returns what was done.",
    }.items(),
)
def test_texts_are_in_the_words_of_python(text, name, expected):
    assert told(text)[name] == expected


def test_an_unknown_struct_is_not_invented():
    assert told(make_docs.generated({"a.hpp": "namespace calligraphy { struct Later; class Core; using A = int; }"})) == {}
