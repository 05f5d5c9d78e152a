// SPDX-License-Identifier: Apache-2.0
// The page over runs whose slopes, speed-ups and floors are known: its figures, its form (by Python's own HTML parser), that it
// loads nothing, and what it says where something is missing.
#include "base/files.h"
#include "image/image.h"
#include "measure/program.h"
#include "measure/report.h"
#include "measure/report_charts.h"
#include "measure/report_text.h"
#include "tests/support/errors.h"
#include "tests/support/made_runs.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <regex>

namespace {

namespace fs = std::filesystem;
using namespace nephroid;
using namespace nephroid::test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ReportPage : public testing::Test {
protected:
  TemporaryFolder temporary;
  fs::path folder = temporary.path();

  std::string page(const std::vector<std::string>& names) const
  {
    std::vector<fs::path> folders;
    for (const std::string& name : names) folders.push_back(folder / name);
    return measure::report_html(folders);
  }
};

/// Every match of the pattern's first group.
std::vector<std::string> all_matches(const std::string& text, const std::string& pattern)
{
  const std::regex regex(pattern);
  std::vector<std::string> all;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match) all.push_back(match->str(1));
  return all;
}

/// A row of the speed-up table as text: cells joined by " | ", tags and the names' numbers left in.
std::vector<std::string> speed_ups(const std::string& html)
{
  std::vector<std::string> rows;
  for (const std::string& row : all_matches(html, "<tr>(<td>.*<strong>.*)</tr>")) {
    const std::string cells = std::regex_replace(row, std::regex("</td><td[^>]*>"), " | ");
    rows.push_back(std::regex_replace(std::regex_replace(cells, std::regex("<[^>]*>"), ""), std::regex("&nbsp;"), " "));
  }
  return rows;
}

/// What Python's parser finds wrong: tags that are not closed in order, ids that are there twice; and how many scripts there are.
std::string complaints(const std::string& html, const fs::path& file)
{
  write_file_whole(file, html);
  const std::string script = R"python(
import sys
from html.parser import HTMLParser
class Check(HTMLParser):
    void = {'meta', 'img', 'input', 'br', 'link'}
    def __init__(self):
        super().__init__(); self.open = []; self.ids = set(); self.wrong = []; self.scripts = 0
    def handle_starttag(self, tag, attributes):
        if tag == 'script': self.scripts += 1
        for name, value in attributes:
            if name == 'id':
                if value in self.ids: self.wrong.append('id ' + value + ' twice')
                self.ids.add(value)
        if tag not in self.void: self.open.append(tag)
    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.void: self.open.pop()
    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag: self.wrong.append(f'</{tag}> at {self.getpos()}')
check = Check()
check.feed(sys.stdin.read()); check.close()
print(check.wrong + check.open, check.scripts)
)python";
  return measure::run_program({"python3", "-c", script}, html, std::chrono::seconds(20));
}

TEST_F(ReportPage, finds_the_slope_and_the_speed_up_of_known_curves)
{
  write_measured_run(folder / "slow", "slow", 3);
  write_measured_run(folder / "fast", "fast", 2);
  const std::string html = page({"slow", "fast"});
  EXPECT_THAT(html, HasSubstr("1 slow, slope −0.50"));
  EXPECT_THAT(html, HasSubstr("2 fast, slope −0.50"));
  // t = (factor / error)^2: at 0.5 after 16 s and 36 s, a speed-up of (3 / 2)^2. Rows go to 0.5 * 1.25^29 = 323 s, errors of 0.167, 0.111.
  EXPECT_THAT(speed_ups(html),
              ElementsAre("2 fast | 1 slow | 1 | 4.00 s | 9.00 s | 2.25 × | ", "2 fast | 1 slow | 0.5 | 16.0 s | 36.0 s | 2.25 × | ",
                          "2 fast | 1 slow | 0.2 | 1 min 40 s | 3 min 45 s | 2.25 × | "));
  EXPECT_THAT(html, HasSubstr("17.0 s (5.0 %)")); // of 323 s of work and 17 s of measuring
}

TEST_F(ReportPage, is_well_formed_and_loads_nothing)
{
  write_measured_run(folder / "a", "a", 3, 0.1);
  write_measured_run(folder / "b", "b", 2, 0.1);
  image::write_exr(folder / "reference.exr", {4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.4f), {}});
  for (const char* name : {"a", "b"}) {
    nlohmann::ordered_json run_json = nlohmann::ordered_json::parse(read_file(folder / name / "run.json"));
    run_json["reference"]["origin"] = (folder / "reference.exr").string();
    write_file_whole(folder / name / "run.json", run_json.dump());
    write_file_whole(
        folder / name / "history.csv",
        measure::to_csv(made_history({{"lab_mean", 3}, {"psnr_db", 9, 0.2}, {"masked_mse", 1, -1}, {"estimated_mse", 1, -1}})));
  }
  const std::string html = page({"a", "b"});
  EXPECT_EQ(complaints(html, folder / "page.html"), "[] 1\n"); // the flipping script
  for (const std::string& address : all_matches(html, R"re((?:src|href|action|data)\s*=\s*["']([^"']{1,30}))re"))
    EXPECT_TRUE(address.starts_with("data:image/png;base64,") || address.starts_with("#")) << address;
  for (const char* load : {"http://", "https://", "//cdn", "@import", "url(", "fetch(", "import("}) EXPECT_THAT(html, Not(HasSubstr(load)));
  EXPECT_EQ(all_matches(html, "(<svg)").size(), 4u);  // lab_mean, masked_mse, mse and psnr_db
  EXPECT_EQ(all_matches(html, "(<img )").size(), 5u); // two runs, their one reference, two differences
}

TEST_F(ReportPage, escapes_what_files_say)
{
  const std::string hostile = "</title><script>alert(1)</script>'\"&\xff `touch x` \x01";
  write_measured_run(folder / "a", "x", 3);
  nlohmann::ordered_json run_json = made_run_json("");
  run_json["name"] = nlohmann::ordered_json::parse(R"("</title><script>alert(1)</script>' \"& `touch x` $(touch x) \u0001 \\")");
  run_json["device"]["name"] = "<script>alert(2)</script>";
  write_file_whole(folder / "a" / "run.json", run_json.dump());
  const std::string html = page({"a"});
  EXPECT_EQ(complaints(html, folder / "page.html"), "[] 1\n");
  EXPECT_THAT(html, AllOf(Not(HasSubstr("<script>alert")), HasSubstr("&lt;script&gt;alert(2)")));
  EXPECT_FALSE(fs::exists("x")); // gnuplot would run what stands in backquotes, outside single quotes
  EXPECT_EQ(measure::escaped(hostile), "&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;&#39;&quot;&amp;\xef\xbf\xbd `touch x`  ");
}

TEST_F(ReportPage, shows_the_noise_floor_and_does_not_compare_near_it)
{
  write_measured_run(folder / "slow", "slow", 3, 0.4);
  write_measured_run(folder / "fast", "fast", 2, 0.4);
  const std::string html = page({"slow", "fast"});
  EXPECT_THAT(html, HasSubstr("noise floor of the reference"));
  EXPECT_THAT(html, HasSubstr("*: near the reference's own noise floor"));
  // Both come down to 0.4, but below twice that the floor is a good part of the error: 1 is compared, 0.5 is not. error^2 = f^2/t + .16
  EXPECT_THAT(speed_ups(html),
              ElementsAre("2 fast | 1 slow | 2 | 1.04 s | 2.34 s | 2.25 × | ", "2 fast | 1 slow | 1 | 4.76 s | 10.7 s | 2.25 × | "));
  // From three floors on the slope of the distance is -1/2 (1 - 1/9) or steeper
  const std::string slope = all_matches(html, "1 slow, slope −(0\\.[0-9]+)").at(0);
  EXPECT_GT(std::stod(slope), 0.44);
  EXPECT_LE(std::stod(slope), 0.50);
}

TEST_F(ReportPage, never_compares_an_error_with_an_estimate)
{
  write_measured_run(folder / "measured", "measured", 3);
  write_made_run(folder / "alone", made_run_json("alone"));
  write_file_whole(folder / "alone" / "history.csv", measure::to_csv(made_history({{"estimated_lab_mean", 2}})));
  const std::string html = page({"measured", "alone"});
  EXPECT_THAT(html, HasSubstr("2 alone (estimate), slope −0.50"));
  EXPECT_THAT(speed_ups(html), ElementsAre());
  EXPECT_THAT(html, HasSubstr("Not compared: 1 and 2 (one is measured against a reference, the other only estimated)"));

  // With estimates of both there is something to compare: the estimates.
  write_file_whole(folder / "measured" / "history.csv", measure::to_csv(made_history({{"lab_mean", 3}, {"estimated_lab_mean", 4}})));
  EXPECT_THAT(speed_ups(page({"measured", "alone"})).at(0),
              AllOf(HasSubstr("2 alone | 1 measured"), HasSubstr("estimate"), HasSubstr("4.00 ×")));
}

TEST_F(ReportPage, warns_of_estimates_with_other_settings)
{
  const auto write = [&](const char* name, double factor, const nlohmann::ordered_json& spectral) {
    write_made_run(folder / name, made_run_json(name), {{"spectral", spectral}});
    write_file_whole(folder / name / "history.csv", measure::to_csv(made_history({{"estimated_lab_mean", factor}})));
  };
  write("fine", 3, {{"threshold_deg", 0.05}, {"photons_per_pass", 1000}});
  write("coarse", 2, {{"threshold_deg", 0.5}, {"photons_per_pass", 1000}});
  const std::string remark = "estimates do not see the bias of different settings: give both a reference";
  EXPECT_THAT(speed_ups(page({"fine", "coarse"})).at(0), AllOf(HasSubstr("2 coarse | 1 fine"), HasSubstr(remark)));
  write("coarse", 2, {{"threshold_deg", 0.05}, {"photons_per_pass", 2000}}); // photons a pass are no bias
  EXPECT_THAT(speed_ups(page({"fine", "coarse"})).at(0), Not(HasSubstr(remark)));
  // Against references the bias is part of the error.
  for (const char* name : {"fine", "coarse"}) write_measured_run(folder / name, name, 3);
  write_file_whole(folder / "coarse" / "preset.json", R"({"spectral": {"threshold_deg": 0.5}})");
  EXPECT_THAT(speed_ups(page({"fine", "coarse"})).at(0), Not(HasSubstr(remark)));
}

TEST_F(ReportPage, says_which_run_was_better_from_the_start)
{
  write_measured_run(folder / "a", "a", 100); // down to 100 / sqrt(323) = 5.6
  write_measured_run(folder / "b", "b", 3);   // from 3 / sqrt(0.5) = 4.2
  EXPECT_THAT(page({"a", "b"}), HasSubstr("Not compared: 1 and 2 (2 was better at its first measurement than 1 ever was)"));
  EXPECT_THAT(page({"b", "a"}), HasSubstr("Not compared: 1 and 2 (1 was better at its first measurement than 2 ever was)"));
}

/// a goes from 7 to 5.90, b from 9 to 6.44: they have 6.44 .. 7 in common, whose middle is 6.71436.
TEST_F(ReportPage, compares_at_three_figures_where_no_round_error_is_common)
{
  for (const auto& [name, begin] : {std::pair{"a", 7.0}, std::pair{"b", 9.0}}) {
    write_measured_run(folder / name, name, 1);
    const double exponent = name == std::string("a") ? -0.026426 : -0.051712; // over a factor of 1.25^29 in time
    const MadeColumn column{"lab_mean", begin / std::pow(0.5, exponent), exponent};
    write_file_whole(folder / name / "history.csv", measure::to_csv(made_history({column})));
  }
  const std::vector<std::string> rows = speed_ups(page({"a", "b"}));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_THAT(rows[0], HasSubstr("1 a | 2 b | 6.71 | "));
}

/// error^2 = 2^2 / t + bias^2 against an estimate of 2 / sqrt(t): at the end, 323 s, noise is 0.11.
TEST_F(ReportPage, says_where_noise_does_not_explain_the_error)
{
  write_measured_run(folder / "a", "a", 2);
  const auto with_bias = [&](double bias) {
    write_file_whole(folder / "a" / "history.csv", measure::to_csv(made_history({{"lab_mean", 2, -0.5, bias}, {"estimated_lab_mean", 2}})));
    return page({"a"});
  };
  EXPECT_THAT(with_bias(0), Not(HasSubstr("Biased")));
  EXPECT_THAT(with_bias(0.1), Not(HasSubstr("Biased")));
  EXPECT_THAT(with_bias(0.25), HasSubstr("Biased:</span> <span"));
}

TEST_F(ReportPage, warns_of_other_scenes_devices_builds_and_references)
{
  write_measured_run(folder / "a", "a", 3);
  write_measured_run(folder / "b", "b", 2, 0, "another.exr");
  EXPECT_THAT(speed_ups(page({"a", "b"})).at(0), HasSubstr("different references"));
  write_measured_run(folder / "b", "b", 2);
  EXPECT_THAT(speed_ups(page({"a", "b"})).at(0), Not(HasSubstr("different")));
  nlohmann::ordered_json other = nlohmann::ordered_json::parse(read_file(folder / "b" / "run.json"));
  other["device"]["name"] = "some GPU";
  other["commit"] = "1234567";
  write_file_whole(folder / "b" / "run.json", other.dump());
  EXPECT_THAT(speed_ups(page({"a", "b"})).at(0), HasSubstr("different devices, different builds of the program"));
  write_file_whole(folder / "b" / "preset.json", R"({"seed": 1, "scene": {"lights": [{"power_w": 2}]}})");
  EXPECT_THAT(speed_ups(page({"a", "b"})).at(0), HasSubstr("different scenes, different devices"));
}

/// Two files with one picture are one reference.
TEST_F(ReportPage, knows_one_reference_by_its_picture)
{
  for (const char* name : {"one.exr", "copy.exr"})
    image::write_exr(folder / name, {4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.4f), {}});
  write_measured_run(folder / "a", "a", 3, 0, (folder / "one.exr").string());
  write_measured_run(folder / "b", "b", 2, 0, (folder / "copy.exr").string());
  EXPECT_THAT(speed_ups(page({"a", "b"})).at(0), Not(HasSubstr("different")));
}

TEST_F(ReportPage, says_whose_a_reference_is_where_there_are_several)
{
  float value = 0.4f;
  for (const char* name : {"one.exr", "two.exr"})
    image::write_exr(folder / name, {4, 3, {"R", "G", "B"}, std::vector<float>(36, value += 0.1f), {}});
  write_measured_run(folder / "a", "a", 3, 0, (folder / "one.exr").string());
  write_measured_run(folder / "b", "b", 2, 0, (folder / "two.exr").string());
  write_measured_run(folder / "c", "c", 2, 0, (folder / "one.exr").string());
  EXPECT_THAT(page({"a", "b", "c"}), AllOf(HasSubstr("</kbd> reference of 1, 3</button>"), HasSubstr("</kbd> reference of 2</button>"),
                                           HasSubstr("data-kind=\"reference\" data-runs=\"0 2\"")));
  EXPECT_THAT(page({"a", "c"}), HasSubstr("</kbd> reference</button>"));
}

TEST_F(ReportPage, takes_a_sweep_as_its_runs)
{
  for (const char* seed : {"1", "2", "3"}) {
    const fs::path run = folder / "sweep" / ("00" + std::string(seed));
    write_measured_run(run, "plate,seed=" + std::string(seed), 3);
    write_file_whole(run / "preset.json", nlohmann::ordered_json{{"seed", std::stoi(seed)}, {"unit", "m"}}.dump());
  }
  const std::string html = page({"sweep"});
  EXPECT_THAT(html, HasSubstr("<h1>plate: 3 runs</h1>"));
  EXPECT_THAT(html, HasSubstr("3 seed=3, slope")); // the part of the name that differs
  EXPECT_THAT(html, HasSubstr("<tr><th><code>seed</code></th><td><code>1</code></td><td><code>2</code></td><td><code>3</code></td></tr>"));
  EXPECT_THAT(html, Not(HasSubstr("<code>unit</code>")));
}

TEST_F(ReportPage, says_what_is_not_there)
{
  write_made_run(folder / "none", made_run_json("none"));
  EXPECT_THAT(page({"none"}), AllOf(HasSubstr("Nothing to draw"), HasSubstr("1&nbsp;none: has no history.csv")));
  write_made_run(folder / "zero", made_run_json("zero"));
  write_file_whole(folder / "zero" / "history.csv", measure::to_csv(made_history({{"lab_mean"}}, 0)));
  EXPECT_THAT(page({"zero"}), AllOf(HasSubstr("Nothing to draw"), HasSubstr("has no row")));
  write_measured_run(folder / "one", "one", 3);
  write_file_whole(folder / "one" / "history.csv", measure::to_csv(made_history({{"lab_mean"}}, 1)));
  EXPECT_THAT(page({"one"}), AllOf(HasSubstr("<svg"), Not(HasSubstr(", slope −"))));
  EXPECT_THAT(page({"one"}), HasSubstr("The reference reference.exr is not there any more."));
  fs::remove(folder / "one" / "image.exr");
  EXPECT_THAT(page({"one"}), AllOf(HasSubstr("image.exr is missing."), HasSubstr("No run has its picture any more")));
}

TEST_F(ReportPage, groups_pictures_by_size)
{
  write_made_run(folder / "a", made_run_json("a"), {{"seed", 1}}, 4, 3, 0.5f);
  write_made_run(folder / "b", made_run_json("b"), {{"seed", 2}}, 4, 3, 0.25f);
  write_made_run(folder / "c", made_run_json("c"), {{"seed", 1}}, 5, 3);
  const std::string html = page({"a", "b", "c"});
  EXPECT_EQ(all_matches(html, "(<figure class=\"viewer\")").size(), 2u);
  EXPECT_THAT(html, AllOf(HasSubstr("4 × 3 pixels"), HasSubstr("5 × 3 pixels"), HasSubstr("2 − 1"), Not(HasSubstr("3 − 1"))));
}

/// The embedded picture is what a display shows of the linear one.
TEST_F(ReportPage, embeds_pictures_as_shown)
{
  write_made_run(folder / "a", made_run_json("a"));
  const std::string encoded = all_matches(page({"a"}), "base64,([A-Za-z0-9+/=]+)").at(0);
  const std::string bytes = measure::run_program({"base64", "--decode"}, encoded, std::chrono::seconds(10));
  write_file_whole(folder / "a.png", bytes);
  const image::Image picture = image::read_image(folder / "a.png");
  EXPECT_EQ(picture.width, 4);
  EXPECT_EQ(picture.height, 3);
  for (const float value : picture.data) EXPECT_NEAR(value, 188 / 255.0, 1e-6); // sRGB of 0.5 is 187.5
}

TEST(Charts, have_ids_of_their_own_and_the_colours_of_the_page)
{
  measure::Chart chart{"a \"title\"", "it's \"1\" (unit)", true, {{"a", 0, false, {{1, 10}, {1, 0.1}}}}, -0.5, {0.05}};
  const std::vector<std::string> svgs = measure::draw_charts(std::vector{chart, chart});
  ASSERT_EQ(svgs.size(), 2u);
  for (const std::string& svg : svgs) {
    EXPECT_THAT(svg, AllOf(testing::StartsWith("<svg aria-label=\"a &quot;title&quot;\" "), testing::EndsWith("</svg>")));
    EXPECT_THAT(svg, AllOf(HasSubstr("it's \"1\" (unit)"), HasSubstr("currentColor"), Not(HasSubstr("black")), Not(HasSubstr("xmlns"))));
  }
  EXPECT_THAT(svgs[0], Not(HasSubstr("chart1-")));
  EXPECT_THAT(svgs[1], Not(HasSubstr("chart0-")));
  EXPECT_THAT(measure::draw_charts({}), ElementsAre());
}

/// Errors from 2.9 down to 2.2 have no power of ten among them, and of 1, 2 and 5 times one only 2.
TEST(Charts, have_several_numbers_on_an_axis_within_a_decade)
{
  const measure::Chart chart{"narrow", "error", true, {{"a", 0, false, {{1, 10, 100}, {2.9, 2.5, 2.2}}}}, {}, {}};
  const std::string svg = measure::draw_charts(std::vector{chart}).at(0);
  for (const char* number : {"2", "2.5", "3", "3.5", "4"}) EXPECT_THAT(svg, HasSubstr(fmt::format(">{}</", number))) << number;
}

TEST(ReportText, reads_as_people_write)
{
  using namespace measure;
  EXPECT_EQ(three_figures(9.9996), "10.0");
  EXPECT_EQ(three_figures(0.00123456), "0.00123");
  EXPECT_EQ(three_figures(1234567), "1230000");
  EXPECT_EQ(three_figures(1.5e-7), "1.50e-07");
  EXPECT_EQ(readable_seconds(0.0123), "12.3 ms");
  EXPECT_EQ(readable_seconds(99.99), "1 min 40 s");
  EXPECT_EQ(readable_seconds(3599.7), "1 h 00 min");
  EXPECT_EQ(readable_seconds(7505), "2 h 05 min");
  EXPECT_EQ(readable_count(9999), "9999");
  EXPECT_EQ(readable_count(8388608), "8.39 million");
  EXPECT_EQ(shortened("aéé", 4), "aé…"); // é takes two bytes
}

/// The vectors of RFC 4648.
TEST(ReportText, base64_is_that_of_the_standard)
{
  const std::string word = "foobar";
  const char* const expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t length = 0; length <= word.size(); ++length) EXPECT_EQ(measure::base64(word.substr(0, length)), expected[length]);
  EXPECT_EQ(measure::base64("\xff\xfe\xfd"), "//79");
}

TEST(Program, gives_back_what_it_reads_however_much)
{
  const std::string large(3'000'000, 'x'); // more than any pipe holds
  EXPECT_EQ(measure::run_program({"cat"}, large, std::chrono::seconds(20)), large);
  EXPECT_EQ(measure::run_program({"printf", "%s", "$(id) `id` *"}, "", std::chrono::seconds(20)), "$(id) `id` *"); // no shell
}

TEST(Program, says_why_it_failed)
{
  const auto line = [](const std::vector<std::string>& command, int milliseconds = 20000) {
    const Error error = error_of([&] { measure::run_program(command, "", std::chrono::milliseconds(milliseconds)); });
    EXPECT_EQ(error.kind(), ErrorKind::failed);
    return error.line();
  };
  EXPECT_EQ(line({"no-such-program"}), "no-such-program: is not installed; install no-such-program");
  EXPECT_EQ(line({"sh", "-c", "echo a reason >&2; exit 3"}), "sh: failed with exit code 3; a reason ");
  EXPECT_EQ(line({"sh", "-c", "kill -9 $$"}), "sh: was ended by signal 9");
  EXPECT_EQ(line({"sleep", "30"}, 100), "sleep: was still at work after 0.1 s");
}

} // namespace
