#include "sequence.hpp"

#include "base/parallel.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

/// Judges each character by itself, in parallel.
SequenceResult judge_each(const std::vector<Character>& characters, const SequenceOptions& options,
                          const std::function<void(double)>& progress,
                          const std::function<SequenceResult(const PracticePage&)>& judge) {
  std::vector<SequenceResult> results(characters.size());
  parallel_for(
      characters.size(), options.threads, progress ? progress : [](double) {},
      [&](std::size_t i) {
        results[i] = judge(page_of(characters[i], options.em));
        results[i].by_character = {results[i].taken};
        for (Finding& finding : results[i].findings) finding.character = characters[i].code;
      });
  SequenceResult all;
  for (const SequenceResult& result : results) all.add(result);
  return all;
}

}  // namespace

std::unique_ptr<Pen> pen_for(const PracticePage& page, const SequenceOptions& options) {
  if (!options.held) return std::make_unique<KinematicPen>(page, options.device, options.renderer);
  return std::make_unique<HeldPen>(page, options.device, options.renderer, GripImpedance{}, options.arm, options.feels);
}

void SequenceResult::add(const SequenceResult& other) {
  taken.add(other.taken);
  tries.add(other.tries);
  by_character.insert(by_character.end(), other.by_character.begin(), other.by_character.end());
  not_finished_exactly += other.not_finished_exactly;
  taken_for_next += other.taken_for_next;
  findings.insert(findings.end(), other.findings.begin(), other.findings.end());
}

SequenceResult judge_attempts(const std::vector<Character>& characters, const SequenceOptions& options,
                              const Attempts& attempts, const std::function<void(double)>& progress) {
  return judge_each(characters, options, progress, [&](const PracticePage& page) {
    SequenceResult result;
    const std::vector<StrokeLine> lines = stroke_lines(page.characters.front());
    const auto code = static_cast<int>(page.characters.front().character.code);
    std::unique_ptr<Pen> pen = pen_for(page, options);
    const auto begin_anew = [&](std::size_t written) {
      pen = pen_for(page, options);
      for (std::size_t i = 0; i < written; ++i) pen->draw(lines[i], options.em);
    };
    const auto is_taken = [&](const Attempt& attempt, std::size_t due) {
      if (pen->draw(attempt.line, options.em).finished) return true;
      if (!attempt.goes_on) return false;
      if (due + 1 == lines.size()) return pen->rest(final_rest).finished;
      return pen->draw(lines[due + 1], options.em).went_on;
    };
    for (std::size_t due = 0; due < lines.size(); ++due) {
      bool taken = false;
      Random random(options.seed, {code, static_cast<int>(due)});
      const std::vector<Attempt> tried = attempts(lines, due, random);
      for (std::size_t i = 0; i < tried.size(); ++i) {
        const bool this_one = is_taken(tried[i], due);
        result.tries.add(this_one);
        if (pen->written() != due) begin_anew(due);  // the next stroke may have been taken for the due one, too
        if (!this_one) continue;
        if (!taken) result.findings.push_back({0, static_cast<int>(due), static_cast<int>(i), tried[i].figure});
        taken = true;
      }
      if (!tried.empty()) result.taken.add(taken);
      const Drawn exactly = pen->draw(lines[due], options.em);
      if (exactly.went_on) {
        ++result.taken_for_next;
        begin_anew(due + 1);
      }
      if (exactly.finished) continue;
      ++result.not_finished_exactly;
      result.findings.push_back({0, static_cast<int>(due)});
      break;
    }
    return result;
  });
}

SequenceResult judge_people(const std::vector<Character>& characters, const SequenceOptions& options,
                            const PeopleDraw& people, const std::function<void(double)>& progress) {
  return judge_each(characters, options, progress, [&](const PracticePage& page) {
    constexpr int exact_attempts = 3;
    SequenceResult result;
    const std::unique_ptr<Pen> pen = pen_for(page, options);
    const std::vector<StrokeLine> lines = stroke_lines(page.characters.front());
    const auto code = static_cast<int>(page.characters.front().character.code);
    const std::vector<StrokeLine> drawn =
        drawn_by_people(lines, people, options.em, Random(options.seed, {code}).bits());
    bool goes_on = true;
    for (std::size_t due = 0; due < lines.size(); ++due) {
      const bool at_once = goes_on && pen->draw(drawn[due], options.em).finished;
      result.taken.add(at_once);
      if (at_once) continue;
      result.findings.push_back({0, static_cast<int>(due), -1, lines[due].length() / options.em});
      for (int i = 0; goes_on && i <= exact_attempts; ++i) {
        goes_on = i < exact_attempts;
        if (goes_on && pen->draw(lines[due], options.em).finished) break;
      }
      if (!goes_on && result.not_finished_exactly == 0) result.not_finished_exactly = 1;
    }
    return result;
  });
}

}  // namespace calligraphy_test
