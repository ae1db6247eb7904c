// The state graph against Wang 2006, Tables 1 and 2, Fig. 6, over every state and every input.
#include "../catch.hpp"

#include <set>
#include <string>
#include <utility>

#include <calligraphy/render/interaction_state.hpp>

using namespace calligraphy;

namespace {

using S = InteractionState;
constexpr S states[] = {S::separation, S::adjusting, S::calibration, S::writing};

TransitionInput input_of(int bits) {
  return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
}

/// The table of interaction_state.hpp, row by row: the first match applies.
S by_table(S from, const TransitionInput& in) {
  struct Row {
    bool from, holds;
    S to;
  };
  const bool ws = from == S::writing;
  const Row rows[] = {{true, !in.contact, S::separation},
                      {ws, in.stroke_finished, S::calibration},
                      {ws, !in.inside_box, S::adjusting},
                      {ws, true, S::writing},
                      {!ws, in.begins && in.may_start && in.inside_box, S::writing},
                      {!ws, in.inside_box, S::calibration},
                      {!ws, true, S::adjusting}};
  for (const Row& row : rows) {
    if (row.from && row.holds) return row.to;
  }
  return S::separation;
}

}  // namespace

TEST_CASE("every state and every input lead to the state of the documented table", "[render]") {
  for (const S from : states) {
    for (int bits = 0; bits < 32; ++bits) {
      INFO(to_string(from) << ", input " << bits);
      CHECK(next_state(from, input_of(bits)) == by_table(from, input_of(bits)));
    }
  }
}

TEST_CASE("Table 1: the meaning of each state holds after every transition", "[render]") {
  for (const S from : states) {
    for (int bits = 0; bits < 32; ++bits) {
      const TransitionInput in = input_of(bits);
      const S to = next_state(from, in);
      CHECK((to == S::separation) == !in.contact);
      if (to == S::adjusting) CHECK_FALSE(in.inside_box);
      if (to == S::writing) CHECK(in.inside_box);
      if (to == S::writing && from != S::writing) CHECK((in.begins && in.may_start));
    }
  }
}

TEST_CASE("repeating an input keeps the state, so no state oscillates by itself", "[render]") {
  for (const S from : states) {
    for (int bits = 0; bits < 16; ++bits) {  // a stroke is finished only once
      const S to = next_state(from, input_of(bits));
      CHECK(next_state(to, input_of(bits)) == to);
    }
  }
}

TEST_CASE("Fig. 6: every state can be reached from every other", "[render]") {
  std::set<std::pair<S, S>> arrows;
  for (const S from : states) {
    for (int bits = 0; bits < 32; ++bits) arrows.insert({from, next_state(from, input_of(bits))});
  }
  CHECK(arrows.size() == 16);
}

TEST_CASE("states have the paper's short names", "[render]") {
  std::string names;
  for (const S state : states) names += to_string(state) + std::string(" ");
  CHECK(names == "SS AS CS WS ");
  CHECK(std::string(to_string(static_cast<S>(77))).empty());
}
