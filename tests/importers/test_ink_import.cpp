// Pen recordings in other formats: expected values are those of the specifications, worked out by hand.
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/ink_import.hpp>

#include "../catch.hpp"

namespace ink_import_tests {

using namespace calligraphy;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

const std::string inkml = R"(<?xml version="1.0" encoding="UTF-8"?>
<inkml:ink xmlns:inkml="http://www.w3.org/2003/InkML"><inkml:definitions>
<inkml:traceFormat xml:id="pen"><inkml:channel name="X" type="integer"/>
<inkml:channel name="Y" type="integer" orientation="-ve"/><inkml:channel name="T" type="integer" units="s"/>
<inkml:channel name="F" type="integer" min="0" max="200"/><inkml:channel name="OA" units="rad"/>
<inkml:channel name="OE" units="deg"/><inkml:intermittentChannels><inkml:channel name="B1" type="boolean" default="F"/>
</inkml:intermittentChannels></inkml:traceFormat>
<inkml:context xml:id="tablet" traceFormatRef="#pen"/><inkml:trace>not drawn</inkml:trace></inkml:definitions>
<inkml:traceGroup contextRef="#tablet"><inkml:annotation type="truth">十</inkml:annotation>
<inkml:trace xml:id="a" continuation="begin">0 100 0 50 0.5 60, '40'0'1'10*60 T,"20"0"0"0*60</inkml:trace>
<inkml:trace continuation="end" priorRef="#a">#64 100 3 ? 0.5 60</inkml:trace>
<inkml:trace type="penUp">90 90 4 0 0.5 60</inkml:trace>
<inkml:trace>50 150 5 200 0.5 60,50 -50 6 100 0.5 60</inkml:trace></inkml:traceGroup></inkml:ink>)";

const std::string signature_pad =
    R"([{"penColor":"black","points":[{"time":1700000000000,"x":0,"y":10,"pressure":0.25},)"
    R"({"time":1700000000250,"x":80,"y":50,"pressure":1}]},)"
    R"({"points":[{"time":1700000001000,"x":40,"y":0,"pressure":0.5},{"time":1700000001100,"x":40,"y":80,"pressure":0.5}]}])";

const std::string tegaki = R"(<character-collection><set name="五"><character><utf8>二</utf8><width>500</width>
<height>500</height><strokes><stroke><point x="50" y="100" timestamp="0"/><point x="450" y="100" timestamp="40"/></stroke>
<stroke><point x="0" y="500" timestamp="1000" pressure="0.75" xtilt="0.5" ytilt="0"/></stroke></strokes></character>
<character><utf8>一</utf8><width>500</width><height>500</height><strokes><stroke><point x="250" y="250" timestamp="7"/>
</stroke></strokes></character></set></character-collection>)";

const std::string svc =
    "5\n1000 5000 70000 1 900 450 1023\n1400 5000 70010 1 0 900 511\n1400 5400 70020 0 0 900 0\n"
    "1000 5400 70030 1 2700 900 1\n1000 4900 70040 1 2700 900 2\n";

const std::string csv =
    "\"Sample ID\";Character;X [px];y;Time_ms;Pen Down;Pressure;tilt_x;tilt_y;Note\n"
    "1;人;0;0;100;1;0,0;0;0;\"a;b\"\n";

const std::string table =
    "sample,character,x,y,t [s],stroke,azimuth [deg],altitude [deg],\"a, note\"\r\n"
    "1,人,0,0,0.5,1,90,60,x\r\n1,人,0,160,0.52,1,90,60,\"x,y\"\"z\"\r\n1,人,40,0,1.5,2,90,60,\r\n2,人,0,0,9,1,-,,\r\n";

const std::string pens = "C 十 5341 lesson 1000 1\nS 2 100 500 0 900 480 330\n";

InkImport read(const std::string& bytes, const std::string& name = "永.txt", const InkOptions& options = {}) {
  return import_ink(bytes, name, options);
}

std::string complaint(const std::string& bytes, const std::string& name = "永.txt", const InkOptions& options = {}) {
  try {
    read(bytes, name, options);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

bool is_noted(const InkImport& import, const std::string& words) {
  for (const std::string& note : import.notes) {
    if (note.find(words) != std::string::npos) return true;
  }
  return false;
}

void check_sample(const TimedPoint& sample, double x, double y, double time) {
  CHECK(sample.point.x() == Approx(x).margin(1e-12));
  CHECK(sample.point.y() == Approx(y).margin(1e-12));
  CHECK(sample.time == Approx(time).margin(1e-9));
}

}  // namespace

TEST_CASE("InkML is read with differences, hexadecimal values, contexts, continuations and a pen in the air",
          "[importers]") {
  const InkImport import = read(inkml);
  CHECK(import.format == InkFormat::inkml);
  REQUIRE(import.traces.size() == 1);
  const PenTrace& trace = import.traces[0];
  CHECK(trace.character == U'十');
  REQUIRE(trace.strokes.size() == 2);
  REQUIRE(trace.strokes[0].size() == 4);
  // x 0, 0 + 40, 40 + (40 + 20), 0x64; the box is 100 wide and, from 150 to -50, 200 high: 250 units are an em.
  check_sample(trace.strokes[0][0], 0.3, 0.7, 0.0);
  check_sample(trace.strokes[0][1], 0.46, 0.7, 1.0);
  check_sample(trace.strokes[0][2], 0.7, 0.7, 2.0);
  check_sample(trace.strokes[0][3], 0.7, 0.7, 3.0);
  check_sample(trace.strokes[1][1], 0.5, 0.1, 6.0);
  CHECK(trace.strokes[0][1].stylus.pressure == Approx(0.3));
  CHECK(std::isnan(trace.strokes[0][3].stylus.pressure));
  CHECK(trace.strokes[1][0].stylus.pressure == 1.0);
  CHECK(trace.strokes[0][2].stylus.altitude == Approx(60.0 * degree));
  CHECK(trace.strokes[0][1].stylus.azimuth == Approx(0.5));  // as before, towards y, which points up
  REQUIRE(trace.air.size() == 3);
  REQUIRE(trace.air[1].size() == 1);
  check_sample(trace.air[1][0], 0.66, 0.66, 4.0);
  CHECK(import.notes.empty());
}

TEST_CASE("InkML's * repeats the number before it, be it a value or a difference", "[importers]") {
  const InkImport import = read("<ink><trace>0 0,'10 '1,* *,\"2 *,* *</trace></ink>");  // x 0 10 20 32 46, y 0 1 2 3 4
  const PenStroke& stroke = import.traces.at(0).strokes.at(0);
  CHECK((stroke.at(2).point - stroke[0].point).x() == Approx(0.8 * 20.0 / 46.0));
  CHECK((stroke.at(4).point - stroke.at(3).point).x() == Approx(0.8 * 14.0 / 46.0));
  CHECK((stroke[0].point - stroke[4].point).y() == Approx(0.8 * 4.0 / 46.0));
}

TEST_CASE("InkML's first trace may lack the timeOffset that the others have", "[importers]") {
  const InkImport import = read(
      "<ink><traceFormat><channel name='X'/><channel name='Y'/><channel name='T' units='dev'/></traceFormat>"
      "<trace>0 0 0,9 9 8</trace><trace timeOffset='100'>0 9 0,9 0 16</trace></ink>");
  CHECK(import.traces.at(0).strokes.at(0).at(1).time == Approx(0.008));
  CHECK(import.traces[0].strokes.at(1).at(1).time == Approx(0.116));
}

TEST_CASE("InkML's characters may be named apart from their traces", "[importers]") {
  const std::string traces = "<ink><annotation type='truth'>$x^2$</annotation><trace id='0'>0 0,9 0</trace>"
                             "<trace id='1'>4 0,4 9</trace><trace id='2'>0 0,8 0</trace><trace id='3'>1 1</trace>";
  const auto group = [](const std::string& label, const std::string& ids) {
    std::string text = "<traceGroup><annotation type='truth'>" + label + "</annotation>";
    for (const char id : ids) text += std::string("<traceView traceDataRef='#") + id + "'/>";
    return text + "</traceGroup>";
  };
  const std::string outer = traces + "<traceGroup><annotation type='truth'>Segmentation</annotation>";
  const InkImport import = read(outer + group("一", "2") + group("十", "01") + "</traceGroup></ink>");
  REQUIRE(import.traces.size() == 2);
  CHECK((import.traces[0].character == U'一' && import.traces[0].strokes.size() == 1));
  CHECK((import.traces[1].character == U'十' && import.traces[1].strokes.size() == 2));
  CHECK(is_noted(import, "1 traces that no traceView names were left out"));
  CHECK(complaint(traces + group("一", "4") + "</ink>").find("names '4', which is no trace") != std::string::npos);
  CHECK(complaint(traces + group("一", "0") + group("二", "0") + "</ink>").find("two groups") != std::string::npos);
}

TEST_CASE("InkML's integers are of the unit and its resolution", "[importers]") {
  const InkImport import = read(
      "<ink><context><inkSource><traceFormat><channel name='X'/><channel name='Y'/><channel name='OE' type='integer' "
      "max='90' units='deg'/></traceFormat><channelProperties><channelProperty channel='OE' name='resolution' "
      "value='100' units='1/deg'/></channelProperties></inkSource></context><trace>0 0 6000,9 9 4500</trace></ink>");
  CHECK(import.traces.at(0).strokes.at(0).at(1).stylus.altitude == Approx(45.0 * degree));
}

TEST_CASE("signature_pad is read in both its forms, with times from 0", "[importers]") {
  const InkImport import = read(signature_pad, "永-2.json");
  CHECK(import.format == InkFormat::signature_pad);
  const PenTrace& trace = import.traces.at(0);
  CHECK(trace.character == U'永');
  CHECK(trace.set == "永-2");
  check_sample(trace.strokes.at(0)[0], 0.1, 0.8, 0.0);  // 80 by 80
  check_sample(trace.strokes.at(1)[1], 0.5, 0.1, 1.1);
  CHECK(trace.strokes[0][0].stylus.pressure == 0.25);
  const std::string old = R"([[{"x":0,"y":0,"time":1700000000000,"color":"black"},{"x":8,"y":0,"time":1700000000020}]])";
  const PenTrace older = read(old).traces.at(0);
  check_sample(older.strokes.at(0).at(1), 0.9, 0.5, 0.02);
  CHECK(std::isnan(older.strokes[0][0].stylus.pressure));
  const std::string erased =
      R"([{"points":[{"x":1,"y":1}]},{"compositeOperation":"destination-out","points":[{"x":1,"y":2}]}])";
  CHECK(read(erased).traces.at(0).strokes.at(0)[0].buttons == -1);
  CHECK(read(erased).traces.at(0).strokes.at(1)[0].buttons == 32);
}

TEST_CASE("Tegaki's characters keep their place in the square", "[importers]") {
  const InkImport import = read(tegaki);
  CHECK(import.format == InkFormat::tegaki);
  REQUIRE(import.traces.size() == 2);
  check_sample(import.traces[0].strokes.at(0).at(1), 0.9, 0.8, 0.04);
  check_sample(import.traces[0].strokes.at(1).at(0), 0.0, 0.0, 1.0);
  CHECK(import.traces[0].strokes[1][0].stylus.pressure == 0.75);
  CHECK(import.traces[1].character == U'一');
  check_sample(import.traces[1].strokes.at(0).at(0), 0.5, 0.5, 0.0);
  const std::string bare =
      "<character><utf8>一</utf8><strokes><stroke><point x='100' y='500'/></stroke></strokes></character>";
  check_sample(read(bare).traces.at(0).strokes.at(0).at(0), 0.1, 0.5, 0.0);  // of 1000, as Tegaki takes it
}

TEST_CASE("SVC is read with the pen in the air and y up", "[importers]") {
  const InkImport import = read(svc, "u6c38_7.svc");
  CHECK(import.format == InkFormat::svc);
  const PenTrace& trace = import.traces.at(0);
  CHECK(trace.character == U'永');
  REQUIRE(trace.strokes.size() == 2);
  check_sample(trace.strokes[0][0], 0.18, 0.26, 0.0);  // 500 of 625 units high, from 4900; 400 wide
  check_sample(trace.strokes[1][0], 0.18, 0.9, 0.03);
  REQUIRE(trace.air.size() == 3);
  CHECK(trace.air[1].size() == 1);
  CHECK(trace.strokes[0][0].stylus.pressure == 1.0);
  CHECK(trace.strokes[0][0].stylus.altitude == Approx(45.0 * degree));
  CHECK(trace.strokes[0][0].stylus.azimuth == Approx(0.0).margin(1e-12));  // 90 degrees clockwise from north: east
  CHECK(std::abs(trace.strokes[1][0].stylus.azimuth) == Approx(180.0 * degree));
  CHECK(is_noted(import, "tenths of a degree"));
  CHECK(is_noted(import, "pressure is of 1023"));
  CHECK(is_noted(import, "y is taken to point up"));
  CHECK(is_noted(read("1\n0 0 5 1\n9 9 15 1\n"), "has 2 samples: the first line says 1"));
}

TEST_CASE("a table is read by the names of its columns, and a gap in a field is not known", "[importers]") {
  const InkImport import = read(table, "lesson.csv", {{}, YAxis::down, {}});
  CHECK(import.format == InkFormat::csv);
  REQUIRE(import.traces.size() == 2);
  const PenTrace& trace = import.traces[0];
  CHECK(trace.character == U'人');
  REQUIRE(trace.strokes.size() == 2);
  check_sample(trace.strokes[0].at(1), 0.4, 0.1, 0.02);  // 160 of 200 units high, 40 wide
  check_sample(trace.strokes[1].at(0), 0.6, 0.9, 1.0);
  CHECK(trace.strokes[0][0].stylus.altitude == Approx(60.0 * degree));
  CHECK(trace.strokes[0][0].stylus.azimuth == Approx(-90.0 * degree));  // towards y, down
  CHECK(std::isnan(import.traces[1].strokes[0][0].stylus.altitude));
  const InkImport tablet = read("T;X;Y;P;Altitude;Azimuth\n1;0;0;9;600;900\n9;1;1;0;600;900\n17;2;2;9;600;900\n");
  CHECK((tablet.traces.at(0).strokes.size() == 2 && is_noted(tablet, "where the pressure is above 0")));
  CHECK(tablet.traces[0].strokes[0][0].stylus.azimuth == Approx(0.0).margin(1e-12));  // Wintab's east
  CHECK(complaint(csv).find("永.txt:2: the pressure is '0,0': expected a number with a decimal point") !=
        std::string::npos);
}

TEST_CASE("what was written is from the file, else the text, else the file's name", "[importers]") {
  const InkOptions text{text_characters("永字"), {}, {}};
  CHECK(read(pens, "永.txt", text).text_used == 0);
  CHECK(read(inkml, "永.txt", text).traces.at(0).character == U'十');
  const InkImport import = read(svc, "乙.svc", text);
  CHECK((import.traces.at(0).character == U'永' && import.text_used == 1));
  CHECK(read(svc, "a/U+4E01.x.svc").traces.at(0).character == U'丁');
  CHECK(read(svc, "a/writer3_永-1.svc").traces.at(0).character == U'永');
  const std::string three = "x,y,stroke,id\n0,0,1,a\n0,0,1,b\n,,,\n0,0,1,c\n";
  CHECK(complaint(three, "永.csv", text).find("--text has 2 characters for this file, and more are needed") !=
        std::string::npos);
  CHECK(read("x,y,stroke,label\n0,0,1,U+5341\n").traces.at(0).character == U'十');
  const InkImport foreign = read("x,y,stroke,label\n0,0,1,\xCA\xAE\n");  // 十 in GBK
  CHECK(is_noted(foreign, "the label 'ʮ' (U+02AE) is no Chinese character: is the file in UTF-8?"));
  CHECK(is_noted(foreign, "--y-axis"));
  CHECK(complaint(svc, "永/2013.svc").find("give the text that was written") != std::string::npos);
}

TEST_CASE("clocks that begin anew in each stroke are strung together, and a time that decreases is refused",
          "[importers]") {
  const InkImport import = read("x,y,time,stroke\n0,0,0,1\n0,9,30,1\n5,0,0,2\n5,9,20,2\n9,0,0,3\n");
  const PenTrace& trace = import.traces.at(0);
  CHECK(trace.strokes.at(1).at(0).time == Approx(0.53));
  CHECK(trace.strokes.at(2).at(0).time == Approx(1.05));
  CHECK(is_noted(import, "begins anew"));
  CHECK(complaint("x,y,t,stroke\n0,0,0,1\n0,9,30,2\n5,0,20,2\n").find(
            "stroke 2: sample 2: the time decreases from 30 to 20") != std::string::npos);
  CHECK(complaint("x,y,t,stroke\n0,0,0,1\n0,9,30,2\n0,9,20,3\n0,9,40,4\n0,9,50,5\n").find("stroke 3") !=
        std::string::npos);
}

TEST_CASE("without times a pen of typical speed is assumed, and told", "[importers]") {
  const InkImport import = read("x,y,stroke\n0,0,1\n0,100,1\n0,0,2\n");
  CHECK(import.traces.at(0).strokes.at(0).at(1).time == Approx(0.8 / 0.82));
  CHECK(import.traces.at(0).strokes.at(1).at(0).time == Approx(0.8 / 0.82 + 0.49));
  CHECK(is_noted(import, "there are no times"));
}

TEST_CASE("the unit of times is seen from their intervals", "[importers]") {
  for (const auto& [step, seconds] : {std::pair{"0.005", 0.005}, {"8", 0.008}, {"12500", 0.0125}}) {
    const std::string text = "x,y,t,stroke\n0,0,0,1\n0,1," + std::string(step) + ",1\n";
    CHECK(read(text).traces.at(0).strokes.at(0).at(1).time == Approx(seconds));
  }
}

TEST_CASE("what cannot be read is refused with the place and the value", "[importers]") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "is empty"},
      {std::string("\xFF\xFE<\0i\0", 6), "is UTF-16, not UTF-8: save it as UTF-8"},
      {"\xE6\xB0", "is not UTF-8 (byte 0 is invalid): save it as UTF-8"},
      {"永", "is none of the formats"},
      {"{\"x\":1,\"y\":2}", "is JSON, but not of signature_pad's toData()"},
      {"[{\"medians\":[[[1,2],[3,4]]]}]", "toData(): characters are read by `calligraphy import`"},
      {"x,y,x,stroke\n", "there are two columns 'x'"},
      {"x;y;stroke\n0,5;0;1\n", "the x is '0,5': expected a number with a decimal point"},
      {"x,pos_x,y,stroke\n", "'x' and 'pos_x' may both be x;"},
      {"x,y,z\n", "no column stroke or pen_down, which tells pen-downs apart; the columns are 'x', 'y', 'z'"},
      {"a,b\n1,2\n", "no column x; the columns are 'a', 'b'"},
      {"x,y,p\n1,2,3\n", "which tells pen-downs apart, and the pressure is never 0"},
      {"x,y,stroke\n1,2\n", "永.txt:2: has 2 fields"},
      {"3\n0 0 0 1\n1 1 1 1\n", "has 2 samples: the first line says 3"},
      {"2\n0 0 0 1\n1 1 1\n", "永.txt:3:"},
      {"[]", "the pen is never down"},
      {"[[{\"x\":1}]]", "stroke 1: a point without x or y"},
      {"[[{\"x\":\"1\",\"y\":2}]]", "x is '1'"},
      {"[[{\"x\":1,\"y\":2}", "not JSON"},
      {"<ink><trace>1 2 3</trace></ink>", "trace 1: a point has too many values"},
      {"<ink><trace>1</trace></ink>", "trace 1: a point has too few values"},
      {"<ink><trace contextRef=\"#a\">1 2</trace></ink>", "no element with the id 'a'"},
      {"<ink><trace>1 2</ink>", "line 1: not XML"},
      {"<character><strokes><stroke><point x=\"1\"/></stroke></strokes></character>", "stroke 1: y is ''"},
      {"x,y,stroke,pressure\n0,0,1,-1\n", "a pressure of -1"}};
  for (const auto& [bytes, words] : cases) {
    INFO(bytes.substr(0, 60));
    CHECK(complaint(bytes).find(words) != std::string::npos);
  }
}

TEST_CASE("deep nesting neither crashes nor takes long", "[importers]") {
  std::string groups = "<ink>", brackets = "[{\"a\":";
  for (int i = 0; i < 100000; ++i) groups += "<traceGroup>", brackets += "[";
  CHECK(complaint(groups).find("not XML") != std::string::npos);
  groups += "<trace>1 2</trace>";
  for (int i = 0; i < 100000; ++i) groups += "</traceGroup>";
  CHECK(read(groups + "</ink>").traces.size() == 1);
  CHECK(complaint("<ink>" + std::string(16 << 20, ' ') + "</ink>").find("larger than 16 MiB") != std::string::npos);
  CHECK(complaint(brackets).find("nested too deeply") != std::string::npos);
}

TEST_CASE("of each format, damaged files give traces that can be written, or an error", "[importers]") {
  std::mt19937 random(5);
  const auto below = [&random](std::size_t most) { return static_cast<std::size_t>(random() % most); };
  const std::string pieces[] = {"9999999999", "-1", "nan", "1e308", ",", "\n", "\"", "<", "'", "0", " ", "?"};
  for (const std::string& whole : {inkml, signature_pad, tegaki, svc, table, pens}) {
    std::size_t read_well = 0;
    constexpr std::size_t mutants = 2000;
    for (std::size_t i = 0; i < mutants; ++i) {
      std::string bytes = whole;
      for (std::size_t change = 0; change <= below(3); ++change) {
        const std::size_t at = below(bytes.size());
        switch (below(3)) {
          case 0:
            bytes[at] = static_cast<char>(below(128));
            break;
          case 1:
            bytes.erase(at, 1 + below(20));
            if (bytes.empty()) bytes = "x";
            break;
          default:
            bytes.insert(at, pieces[below(std::size(pieces))]);
        }
      }
      try {
        pen_traces_text(read(bytes).traces);
        ++read_well;
      } catch (const FormatError&) {
      }
    }
    CHECK((read_well > 0 && read_well < mutants));
  }
}

}  // namespace ink_import_tests
