// import_characters on small artificial sources; test_corpora.cpp tests the real ones.
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/set_encoding.hpp>

#include "../catch.hpp"
#include "../temporary_directory.hpp"

using namespace calligraphy;

namespace {

/// A KanjiVG file; each stroke is a label and path data.
std::string kanjivg(const std::vector<std::pair<std::string, std::string>>& strokes, const std::string& notice = "") {
  std::string text = notice + "<svg viewBox=\"0 0 109 109\"><g>";
  for (const auto& [label, data] : strokes) text += "<path kvg:type=\"" + label + "\" d=\"" + data + "\"/>";
  return text + "</g></svg>";
}

const std::string heng = "M10,50c30,0,60,-1,90,-2";
const std::string shu = "M50,10c0,30,0,60,0,85";
const std::string shu_with_hook = "M50,10c0,30,0,60,0,85c-4,-3,-8,-6,-12,-9";
const std::string steep_heng = "M20,70c20,-10,40,-20,60,-30";  // rises by 27 degrees, as a ti does

const std::string hanzi_writer_heng = R"({"medians":[[[100,400],[900,400]]]})";
const std::string named_heng = R"({"character":"一","medians":[[[100,400],[900,400]]]})";
const std::string hanzi_writer_cross = R"({"medians":[[[100,400],[900,400]],[[512,800],[512,0]]]})";

std::string complaint(const std::filesystem::path& source, const ImportOptions& options = {}) {
  try {
    import_characters(source, options);
  } catch (const FormatError& error) {
    return std::string("FormatError ") + error.what();
  } catch (const FileError& error) {
    return std::string("FileError ") + error.what();
  } catch (const ValueError& error) {
    return std::string("ValueError ") + error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string text_of(const CharacterList& list) {
  std::ostringstream out;
  write_characters(out, list);
  return out.str();
}

}  // namespace

TEST_CASE("the kind of a source is detected from its content", "[practice]") {
  const TemporaryDirectory brush, lines, both, neither;
  brush.write("package/一.json", hanzi_writer_heng);
  lines.write("deep/down/04e00.svg", kanjivg({{"㇐", heng}}));
  both.write("一.json", hanzi_writer_heng);
  both.write("04e00.svg", kanjivg({{"㇐", heng}}));
  neither.write("readme.json", "{}");
  neither.write("picture.svg", "<svg/>");
  neither.write("4e00.svg", "<svg/>");
  for (const TemporaryDirectory* const directory : {&brush, &lines}) {
    const ImportResult import = import_characters(directory->path());
    CHECK(import.report.kind == (directory == &brush ? SourceKind::hanzi_writer_data : SourceKind::kanjivg));
    REQUIRE(import.list.characters.size() == 1);
    CHECK(import.list.characters[0].code == U'一');
    CHECK(import.list.characters[0].sequence.stroke_ids == std::vector<int>{1});
  }
  CHECK(has(complaint(both.path()), "both hanzi-writer-data and KanjiVG"));
  CHECK(has(complaint(neither.path()), "contains no character file"));
  CHECK(has(complaint(neither.path() / "none"), "no such file or directory"));
}

TEST_CASE("the text format and set files are imported unchanged, by ascending code point", "[practice]") {
  const TemporaryDirectory directory;
  const std::string head = "calligraphy characters 2\nsource s\nlicence l\nattribution a\n";
  const std::string one = "\ncharacter 一\nstroke 1 0.1,0.5 0.9,0.5\n";
  const std::string ten = "\ncharacter 十\nstroke 1 0.1,0.5 0.9,0.5\nstroke 2 0.5,0.9 0.5,0.1\n";
  directory.write("own.txt", head + ten + one);
  const ImportResult import = import_characters(directory.path() / "own.txt");
  CHECK(text_of(import.list) == head + one + ten);
  CHECK(import.report.kind == SourceKind::calligraphy);
  CHECK(import.report.characters == 2);
  CHECK(import.report.strokes == 3);
  CHECK(import.report.ids_used[1] == 2);
  ImportOptions options;
  options.only = U"永一";
  CHECK(text_of(import_characters(directory.path() / "own.txt", options).list) == head + one);
  options.only = U"永";
  CHECK(has(complaint(directory.path() / "own.txt", options), "no character that was requested"));
  const std::vector<std::byte> bytes = encode_character_set(import.list, CoordinatePrecision::exact);
  directory.write("own.set", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  CHECK(text_of(import_characters(directory.path() / "own.set").list) == head + one + ten);
  directory.write("other.bin", std::string(300, 'x'));
  CHECK(has(complaint(directory.path() / "other.bin"), "FormatError"));
}

TEST_CASE("characters are sorted by code point and do not depend on the number of threads", "[practice]") {
  const TemporaryDirectory directory;
  for (const char* const name : {"永", "一", "十", "丁", "七", "丈"}) {
    directory.write(std::string(name) + ".json", hanzi_writer_cross);
  }
  ImportOptions options;
  options.threads = 1;
  const ImportResult expected = import_characters(directory.path(), options);
  REQUIRE(expected.list.characters.size() == 6);
  for (std::size_t i = 1; i < 6; ++i) CHECK(expected.list.characters[i - 1].code < expected.list.characters[i].code);
  CHECK(expected.report.strokes == 12);
  CHECK(expected.report.ids_used[2] == 6);
  for (const int threads : {0, 2, 5, 64}) {
    options.threads = threads;
    CHECK(text_of(import_characters(directory.path(), options).list) == text_of(expected.list));
  }
}

TEST_CASE("a label decides between strokes that follow the drawing, and is overridden by the shape", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("04e00.svg", kanjivg({{"㇐", heng},           // agrees
                                        {"㇐", steep_heng},     // accepted: geometry alone says ti
                                        {"㇑", shu_with_hook},  // overridden: a line loses the hook
                                        {"６", heng},           // unknown
                                        {"", shu},
                                        {"㇐", shu}}));  // none
  const ImportResult import = import_characters(directory.path());
  const ImportReport& report = import.report;
  CHECK(import.list.characters[0].sequence.stroke_ids == std::vector<int>{1, 1, 12, 1, 2, 2});
  CHECK(report.labelled == 4);
  CHECK(report.agreed == 1);
  REQUIRE(report.label_conflicts.size() == 4);
  CHECK(report.label_conflicts[0].place.stroke == 2);
  CHECK(report.label_conflicts[0].resolution == LabelResolution::accepted);
  CHECK(report.label_conflicts[0].recognised == 10);
  CHECK(report.label_conflicts[0].id == 1);
  CHECK(report.label_conflicts[1].place.stroke == 3);
  CHECK(report.label_conflicts[1].resolution == LabelResolution::overridden);
  CHECK(report.label_conflicts[1].id == 12);
  CHECK(report.label_conflicts[2].place.stroke == 4);
  CHECK(report.label_conflicts[2].resolution == LabelResolution::unknown);
  CHECK(report.label_conflicts[3].place.stroke == 6);
  CHECK(report.label_conflicts[3].resolution ==
        LabelResolution::overridden);  // a line fits, but a heng never runs downwards
  REQUIRE(report.confusions.size() == 3);
  CHECK(report.confusions[0].count == 1);
}

TEST_CASE("stroke letters are used as labels if there is one per stroke", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("data/一.json", hanzi_writer_heng);
  directory.write("data/十.json", hanzi_writer_cross);
  directory.write("data/丁.json", hanzi_writer_cross);
  directory.write("letters.js", R"js(x=JSON.parse('{"一":"jj","十":"jf"}'))js");
  ImportOptions options;
  options.letters = directory.path() / "letters.js";
  const ImportResult import = import_characters(directory.path() / "data", options);
  CHECK(import.report.labelled == 2);
  CHECK(import.report.agreed == 2);
  CHECK(import.report.letters_unused == std::vector<char32_t>{U'一'});
  CHECK(has(import.list.provenance.attribution, "cnchar-order"));

  directory.write("lines/04e00.svg", kanjivg({{"㇐", heng}}));
  CHECK(has(complaint(directory.path() / "lines", options), "ValueError letters"));
}

TEST_CASE("variants become alternate orders on request, kana are imported on request, duplicates once", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("a/05341.svg", kanjivg({{"㇐", heng}, {"㇑", shu}}));
  directory.write("b/05341.svg", kanjivg({{"㇐", heng}, {"㇑", shu}}));
  directory.write("a/05341-VtFst.svg", kanjivg({{"㇑", shu}, {"㇐", heng}}));
  directory.write("a/03044.svg", kanjivg({{"", heng}}));
  directory.write("a/05341-a_b.svg", "no name of a variant");
  const auto reasons = [](const ImportResult& import) {
    std::vector<std::string> all;
    for (const SkippedFile& file : import.report.skipped) all.push_back(file.path + ": " + file.reason);
    return all;
  };
  const ImportResult plain = import_characters(directory.path());
  CHECK(plain.list.characters.size() == 1);
  CHECK(reasons(plain) == std::vector<std::string>{
                              "a/03044.svg: not an ideograph", "a/05341-VtFst.svg: an alternate order",
                              "a/05341-a_b.svg: not a character file", "b/05341.svg: a duplicate of an earlier file"});
  ImportOptions options;
  options.alternates = true;
  options.ideographs_only = false;
  const ImportResult all = import_characters(directory.path(), options);
  REQUIRE(all.list.characters.size() == 3);
  CHECK(all.list.characters[0].code == U'い');
  CHECK(all.list.characters[1].order.empty());
  CHECK(all.list.characters[1].sequence.stroke_ids == std::vector<int>{1, 2});
  CHECK(all.list.characters[2].order == "VtFst");
  CHECK(all.list.characters[2].sequence.stroke_ids == std::vector<int>{2, 1});
}

TEST_CASE("an import states its source, its licence and that it was modified", "[practice]") {
  const TemporaryDirectory brush, lines;
  brush.write("一.json", hanzi_writer_heng);
  Provenance found = import_characters(brush.path()).list.provenance;
  CHECK(found.source == "Make Me a Hanzi");
  CHECK(found.licence_text.empty());
  const std::vector<std::string> notes = import_characters(brush.path()).report.notes;
  CHECK((notes.size() == 1 && has(notes[0], "drawings of your own")));

  brush.write("ARPHICPL.TXT", "ARPHIC PUBLIC LICENSE\r\nTerms\r");
  brush.write("package.json", R"({"name":"hanzi-writer-data","version":"2.0.1"})");
  brush.write("inner/ARPHICPL.TXT", "another");
  ImportOptions options;
  options.date = "2026-11-21";
  const ImportResult import = import_characters(brush.path(), options);
  found = import.list.provenance;
  CHECK(found.source == "Make Me a Hanzi, as hanzi-writer-data 2.0.1");
  CHECK(found.licence == "Arphic Public License");
  CHECK(has(found.attribution, "Arphic Technology"));
  CHECK(has(found.attribution, "changed by calligraphy: fitted to typical strokes on 2026-11-21"));
  CHECK(found.licence_text == "ARPHIC PUBLIC LICENSE\nTerms\n");
  CHECK(import.report.notes.empty());

  lines.write("04e00.svg", kanjivg({{"㇐", heng}}, "<!-- Copyright U. Apel -->"));
  lines.write("package.json", R"({"name":"x\n","version":7})");
  found = import_characters(lines.path()).list.provenance;
  CHECK(found.source == "KanjiVG");
  CHECK(found.licence == "Creative Commons Attribution-Share Alike 3.0");
  CHECK(has(found.attribution, "Ulrich Apel"));
  CHECK(found.licence_text == " Copyright U. Apel ");

  lines.write("own/04e00.svg", "<svg viewBox=\"0 0 109 109\"><path d=\"" + heng + "\"/></svg>");
  const ImportResult own = import_characters(lines.path() / "own");
  CHECK(own.list.provenance.source == "drawings in SVG");
  CHECK(own.list.provenance.licence.empty());
  CHECK(own.list.provenance.attribution == "changed by calligraphy: fitted to typical strokes");
  CHECK(own.report.notes.size() == 1);
}

TEST_CASE("files in another encoding or of another form are told by their name and what was expected", "[practice]") {
  const auto utf16 = [](const std::string& text) {
    std::string bytes = "\xFF\xFE";
    for (const char c : text) bytes += {c, '\0'};
    return bytes;
  };
  const std::string map = "{\"十\": " + hanzi_writer_cross + "}";
  const std::string list = "[\n" + named_heng + ",\n" + named_heng + "\n]";
  const std::vector<std::pair<std::string, std::pair<std::string, std::string>>> cases = {
      {"graphics16.txt", {utf16(named_heng), "is UTF-16"}},
      {"一.json", {utf16(hanzi_writer_heng), "is UTF-16"}},
      {"04e00.svg", {utf16(kanjivg({{"", heng}})), "is UTF-16"}},
      {"own.txt", {utf16("calligraphy characters 2\n"), "is UTF-16"}},
      {"二.json", {"{\"character\":\"\xB6\xFE\"}", "is not UTF-8 (byte 14 is invalid): save it as UTF-8"}},
      {"三.json", {"{\"medians\":[,", "not JSON at byte 13"}},
      {"map.json", {map, "is an object of objects: expected one character"}},
      {"list", {list, "is an array: expected one character"}}};
  for (const auto& [name, content] : cases) {
    const TemporaryDirectory directory;
    directory.write(name, content.first);
    const std::string path = (directory.path() / name).string(), said = complaint(path);
    INFO(said);
    CHECK(said.starts_with("FormatError " + path + ":"));
    CHECK(has(said, content.second));
    CHECK_FALSE(has(said, "json.exception"));
  }
}

TEST_CASE("unusable files are skipped with the reason, or the first fails a strict import, for any number of threads",
          "[practice]") {
  const TemporaryDirectory directory;
  for (int code = 0x4E00; code < 0x4E40; ++code) {
    char name[16];
    std::snprintf(name, sizeof name, "%05x.svg", static_cast<unsigned>(code));
    const bool faulty = code == 0x4E10 || code >= 0x4E20;
    directory.write(name, kanjivg({{"㇐", heng}, {"㇐", faulty ? "M1,2B3,4" : heng}}));
  }
  const std::string reason =
      "stroke 2: path data at byte 4: command 'B': expected one of M, L, H, V, C, S, Q, T, A and Z";
  ImportOptions options;
  for (const int threads : {1, 2, 8}) {
    options.threads = threads;
    options.strict = false;
    const ImportResult import = import_characters(directory.path(), options);
    CHECK(import.list.characters.size() == 31);
    CHECK(import.report.characters == 31);
    REQUIRE(import.report.skipped.size() == 33);
    CHECK(import.report.skipped[0].path == "04e10.svg");
    CHECK(import.report.skipped[0].reason == reason);
    CHECK(import.report.skipped[0].unusable);
    options.strict = true;
    CHECK(complaint(directory.path(), options) ==
          "FormatError " + directory.path().string() + ": 04e10.svg: " + reason);
  }
  const TemporaryDirectory useless;
  useless.write("一.json", "{}");
  useless.write("二.json", "{");
  CHECK(complaint(useless.path()) == "FormatError " + useless.path().string() + ": 一.json: medians: missing");
}

TEST_CASE("one file of another kind among twenty is unusable, not the source", "[practice]") {
  const TemporaryDirectory directory;
  for (int code = 0x4E00; code < 0x4E14; ++code) {
    char name[16];
    std::snprintf(name, sizeof name, "%05x.svg", static_cast<unsigned>(code));
    directory.write(name, kanjivg({{"㇐", heng}}));
  }
  directory.write("永.json", hanzi_writer_heng);
  const ImportResult import = import_characters(directory.path());
  CHECK((import.report.kind == SourceKind::kanjivg && import.list.characters.size() == 20));
  REQUIRE(import.report.skipped.size() == 1);
  CHECK((import.report.skipped[0].unusable && has(import.report.skipped[0].reason, "unlike the other files")));
  ImportOptions options;
  options.strict = true;
  CHECK(has(complaint(directory.path(), options), "contains both hanzi-writer-data and KanjiVG"));
}

TEST_CASE("a character is named in many ways, and a name that the file contradicts makes it unusable", "[practice]") {
  for (const char* const name :
       {"%E4%B8%80.json", "19968.json", "U+4E00.json", "u4e00.json", "4e00.json", "04e00.json",
        "一 (1).JSON", "一\U000E0100.json"}) {
    INFO(name);
    const TemporaryDirectory directory;
    directory.write(name, hanzi_writer_heng);
    for (const std::filesystem::path& source : {directory.path(), directory.path() / name}) {
      const ImportResult import = import_characters(source);
      REQUIRE(import.list.characters.size() == 1);
      CHECK(import.list.characters[0].code == U'一');
    }
  }
  const TemporaryDirectory hexadecimal;
  hexadecimal.write("05341.json", hanzi_writer_cross);  // by the zero, for all its digits are decimal
  CHECK(import_characters(hexadecimal.path()).list.characters.at(0).code == U'十');
  const TemporaryDirectory directory;
  directory.write("a/data.json", named_heng);
  directory.write("b/二.json", named_heng);
  directory.write("c/一.json", named_heng);
  directory.write("d/other.json", R"({"name":"x"})");
  const ImportResult import = import_characters(directory.path());
  CHECK(import.list.characters.size() == 1);
  REQUIRE(import.report.skipped.size() == 3);
  CHECK(import.report.skipped[0].reason == "character: 一 (U+4E00), but its name says 二 (U+4E8C)");
  CHECK(import.report.skipped[0].unusable);
  CHECK(import.report.skipped[1].reason == "a duplicate of an earlier file");
  CHECK_FALSE(import.report.skipped[1].unusable);
  CHECK(import.report.skipped[2].reason == "not a character file");
  directory.write("e/04e00.svg", kanjivg({{"㇐", heng}}));
  CHECK(import_characters(directory.path() / "e" / "04e00.svg").report.kind == SourceKind::kanjivg);
}

TEST_CASE("a file with a character a line is read line by line", "[practice]") {
  const auto line = [](const std::string& character, const std::string& point) {
    return R"({"character":")" + character + R"(","medians":[[[100,400],)" + point + "]]}\n";
  };
  const TemporaryDirectory directory;
  directory.write("graphics.txt", line("二", "[900,400]") + "\n" + line("一", "[900,400]") + line("十", "[900]") + "{\n" +
                                      line("三三", "[900,400]"));
  directory.write("dictionary.txt", "{}");
  const ImportResult import = import_characters(directory.path());
  CHECK(import.report.kind == SourceKind::make_me_a_hanzi);
  REQUIRE(import.list.characters.size() == 2);
  CHECK(import.list.characters[0].code == U'一');
  REQUIRE(import.report.skipped.size() == 4);
  CHECK(import.report.skipped[1].path == "graphics.txt: line 4");
  CHECK(import.report.skipped[1].reason == "medians[0][1]: expected two finite numbers");
  CHECK(has(import.report.skipped[2].reason, "not JSON"));
  CHECK(has(import.report.skipped[3].reason, "expected one character"));
  CHECK(text_of(import_characters(directory.path() / "graphics.txt").list) == text_of(import.list));
  directory.write("graphicsJa.txt", line("一", "[900,400]"));
  CHECK(import_characters(directory.path() / "graphicsJa.txt").report.kind == SourceKind::anim_cjk);
  CHECK(has(complaint(directory.path()), "both Make Me a Hanzi and animCJK"));
}

TEST_CASE("pictures beside graphics.txt are left out, and names in other encodings are told", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("graphics.txt", R"({"character":"一","medians":[[[100,400],[900,400]]]})");
  directory.write("svgs/19968.svg",
                  "<svg viewBox=\"0 0 1024 1024\"><g transform=\"scale(1, -1) translate(0, -900)\"/></svg>");
  directory.write("APL/english/ARPHICPL.TXT", "APL");
  directory.write("\xCA\xAE.json", hanzi_writer_cross);  // 十 in GBK, U+02AE in UTF-8
  directory.write("\xD3\xC0.json", hanzi_writer_cross);  // 永 in GBK
  const ImportResult import = import_characters(directory.path());
  CHECK(import.list.characters.size() == 1);
  REQUIRE(import.report.skipped.size() == 3);
  CHECK(import.list.provenance.licence_text == "APL");
  CHECK((!import.report.skipped[0].unusable && has(import.report.skipped[0].reason, "a picture of Make Me a Hanzi")));
  CHECK((import.report.skipped[1].unusable && has(import.report.skipped[1].reason, "its name is not in UTF-8")));
  CHECK(has(import.report.skipped[2].reason, "its name is not in UTF-8"));
}

TEST_CASE("KanjiVG as one XML file is read kanji by kanji", "[practice]") {
  const TemporaryDirectory directory;
  const auto kanji = [](const std::string& code, const std::string& data) {
    return "<kanji id=\"kvg:kanji_" + code + "\">\n<g><path kvg:type=\"㇐\" d=\"" + data + "\"/></g></kanji>\n";
  };
  directory.write("kanjivg.xml", "<?xml version=\"1.0\"?>\n<!--By U. A.-->\n<kanjivg>\n" + kanji("00041", heng) +
                                     kanji("04e8c", "M1,2B") + kanji("04e00", heng) + "</kanjivg>\n");
  const ImportResult import = import_characters(directory.path() / "kanjivg.xml");
  REQUIRE(import.list.characters.size() == 1);
  CHECK(import.list.characters[0].code == U'一');
  CHECK(import.list.provenance.licence_text == "By U. A.");
  REQUIRE(import.report.skipped.size() == 2);
  CHECK(import.report.skipped[1].path == "kanjivg.xml: kanji 04e8c");
  CHECK(has(import.report.skipped[1].reason, "path data at byte 4"));
}

TEST_CASE("animCJK is in the frame of hanzi-writer-data, and the parts of its strokes belong together", "[practice]") {
  const std::string first = R"svg(<path id="z19968d1a" d="M100 476L600 476L600 516L100 516Z"/>)svg";
  // The other way round.
  const std::string second = R"svg(<path id="z19968d1b" d="M900 476L500 476L500 516L900 516Z"/>)svg";
  const std::string medians = R"svg(<path clip-path="url(#z19968c1a)" d="M110 496 890 496"/>
      <path clip-path="url(#z19968c1b)" d="M-110 496 890 496"/>)svg";
  const std::string head = R"(<!-- Copyright --><svg id="z19968" viewBox="0 0 1024 1024">)";
  const TemporaryDirectory animated, plain;
  animated.write("svgsJa/19968.svg", head + first + second + medians + "</svg>");
  plain.write("一.json", R"({"strokes":["M100 424L900 424L900 384L100 384Z"],"medians":[[[110,404],[890,404]]]})");
  const ImportResult import = import_characters(animated.path());
  CHECK(import.report.kind == SourceKind::anim_cjk);
  CHECK(import.list.provenance.licence_text == " Copyright ");
  const Character found = import.list.characters.at(0);
  const Character expected = import_characters(plain.path()).list.characters.at(0);
  REQUIRE(found.stroke_count() == 1);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK((found.structure.control_points[i] - expected.structure.control_points[i]).norm() < 1e-9);
  }
  for (std::size_t k = 0; k < max_ink_knots; ++k) {
    CHECK(found.physics.ink.at(0).half_widths[k] == Approx(expected.physics.ink.at(0).half_widths[k]).margin(1e-3));
  }
  animated.write("svgsJa/19977.svg", head + first + "</svg>");
  animated.write("svgsJa/19978.svg", R"(<svg id="z19978" viewBox="0 0 1024 1024">)" + first + "</svg>");
  const std::vector<SkippedFile> skipped = import_characters(animated.path()).report.skipped;
  REQUIRE(skipped.size() == 2);
  CHECK(has(skipped[0].reason, "its name says 三 (U+4E09)"));
  CHECK(has(skipped[1].reason, "stroke 1: has no median"));
}

TEST_CASE("a stroke order that is known to be wrong is put right where it was drawn, and no other", "[practice]") {
  // Of 冉, whose third stroke begins at 392,447: the shu is due before the heng (data/order_corrections.tsv).
  const auto drawn = [](const std::string& third) {
    return R"({"medians":[[[200,700],[200,0]],[[200,700],[800,700]],[[)" + third +
           R"(],[900,447]],[[512,800],[512,100]],[[100,300],[900,300]]]})";
  };
  const auto imported = [](const std::string& json, const ImportOptions& options = {}) {
    const TemporaryDirectory directory;
    directory.write("冉.json", json);
    return import_characters(directory.path(), options);
  };
  const std::vector<int> wrong = {2, 1, 1, 2, 1}, right = {2, 1, 2, 1, 1};
  const ImportResult corrected = imported(drawn("392,447"));
  CHECK(corrected.list.characters.at(0).sequence.stroke_ids == right);
  REQUIRE(corrected.report.corrected.size() == 1);
  CHECK(has(corrected.list.provenance.attribution, "; some stroke orders corrected"));
  CHECK(corrected.report.corrected[0].code == U'冉');
  CHECK(corrected.report.corrected[0].reason == "the shu before the heng");
  for (const char* const elsewhere : {"392,459", "380,447"}) {
    const ImportResult other = imported(drawn(elsewhere));
    CHECK(other.list.characters.at(0).sequence.stroke_ids == wrong);
    CHECK(other.report.corrected.empty());
  }
  ImportOptions options;
  options.corrections = false;
  CHECK(imported(drawn("392,447"), options).list.characters.at(0).sequence.stroke_ids == wrong);
  const TemporaryDirectory others;
  others.write("lines/04e00.svg", kanjivg({{"㇐", heng}}));
  others.write("own.txt", text_of(corrected.list));
  for (const char* const source : {"lines", "own.txt"}) {
    CHECK(has(complaint(others.path() / source, options), "ValueError corrections: applies only to"));
  }
}

TEST_CASE("a compatibility ideograph or a radical asks for the ideograph that it means", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("data/一.json", hanzi_writer_heng);
  directory.write("data/十.json", hanzi_writer_cross);
  directory.write("own.txt", text_of(import_characters(directory.path() / "data").list));
  ImportOptions options;
  options.only = U"\u2F00";  // Kangxi radical one
  for (const char* const source : {"data", "own.txt"}) {
    const CharacterList list = import_characters(directory.path() / source, options).list;
    REQUIRE(list.characters.size() == 1);
    CHECK(list.characters[0].code == U'一');
  }
}

TEST_CASE("import options outside their domain are rejected by name", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("一.json", hanzi_writer_heng);
  ImportOptions options;
  options.threads = -1;
  CHECK(has(complaint(directory.path(), options), "ValueError threads = -1"));
  options.threads = 257;
  CHECK(has(complaint(directory.path(), options), "ValueError threads = 257"));
  options = {};
  options.date = "2026\n11";
  CHECK(has(complaint(directory.path(), options), "ValueError date"));
  options = {};
  options.alternates = true;
  CHECK(complaint(directory.path(), options) ==
        "ValueError alternates: applies only to KanjiVG, not to hanzi-writer-data");
  options = {};
  options.ideographs_only = false;
  CHECK(has(complaint(directory.path(), options), "ValueError ideographs_only: applies only to KanjiVG"));
}

TEST_CASE("fit counts include strokes, and characters by their worst stroke", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("一.json", hanzi_writer_heng);
  // No typical stroke follows zigzags of 12 % of the em within 4 %.
  std::string zigzag = R"({"medians":[[[100,400],[900,400]],[)";
  for (int i = 0; i <= 16; ++i) {
    zigzag += (i > 0 ? ",[" : "[") + std::to_string(100 + 50 * i) + "," + std::to_string(i % 2 == 0 ? 600 : 720) + "]";
  }
  directory.write("二.json", zigzag + "]]}");
  const ImportReport report = import_characters(directory.path()).report;
  for (const FitCount& count : report.within) {
    CHECK(count.strokes == 2);
    CHECK(count.characters == 1);
  }
  REQUIRE(report.worst.size() == 3);
  CHECK(report.worst[0].place.code == U'二');
  CHECK(report.worst[0].place.stroke == 2);
  CHECK(report.worst[0].error > 0.04);
}
