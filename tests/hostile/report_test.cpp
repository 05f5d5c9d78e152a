// SPDX-License-Identifier: Apache-2.0
// `nephroid report` over real runs, and over what is no run, not finished, cut, damaged or too much: one clear line,
// exit code 2, and no page. Where Chromium is installed, the page is looked at in it.
#include "tests/support/made_runs.h"
#include "tests/support/program_test.h"

namespace nephroid::report_test {

using nephroid::read_file;
using nephroid::write_file_whole;
using Json = nlohmann::ordered_json;

class Reports : public ProgramTest {
protected:
  Ended report(std::vector<std::string> arguments, const Environment& environment = {}) const {
    arguments.insert(arguments.begin(), "report");
    return run(arguments, environment);
  }

  /// The line that the report over these folders is refused with.
  std::string refusal(const std::vector<std::string>& folders) const {
    std::vector<std::string> arguments = folders;
    arguments.insert(arguments.end(), {"-o", "page.html"});
    const Ended ended = report(arguments);
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    expect_one_line(ended);
    EXPECT_FALSE(fs::exists(folder / "page.html"));
    return ended.err;
  }

  /// A good run, then one of its files replaced.
  std::string refusal_with(const std::string& file, const std::string& content) const {
    write_measured_run(folder / "run", "run", 3);
    write_file_whole(folder / "run" / file, content);
    return refusal({"run"});
  }
  std::string refusal_with_run_json(const std::string& pointer, const Json& value) const {
    Json json = made_run_json("run");
    json[Json::json_pointer(pointer)] = value;
    return refusal_with("run.json", json.dump());
  }
};

TEST_F(Reports, are_made_of_real_runs) {
  const std::vector<std::string> small{"run",           "spectral/plate",
                                       "--set",         "scene.camera.resolution=[48,40]",
                                       "--set",         "spectral.photons_per_pass=20000",
                                       "--passes",      "64",
                                       "--pictures-at", "0.05,0.1,0.2,0.4"}; // each is measured: a slope takes several
  for (const char* seed : {"1", "2"}) {
    std::vector<std::string> arguments = small;
    arguments.insert(arguments.end(), {"--seed", seed, "-o", std::string("seed") + seed});
    ASSERT_EQ(run(arguments).exit_code, 0);
  }
  const Ended ended = report({"seed1", "seed2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("report.html: "));
  const std::string html = read_file(folder / "report.html");
  for (const char* part :
       {R"("seed":"1")", R"("seed":"2")", R"("metric":"lab_mean")", R"("estimate":true,"slope":-0.)", R"("runs":false)",
        R"("width":48,"height":40)", R"("kind":"difference","runs":[1],"from":0)"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_EQ(report({"seed1"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "seed1" / "report.html"));
}

TEST_F(Reports, of_no_run_are_refused) {
  fs::create_directories(folder / "empty");
  write_file_whole(folder / "file", "");
  EXPECT_EQ(refusal({"none"}), "nephroid: none: there is no such folder\n");
  EXPECT_THAT(refusal({"empty"}), HasSubstr("nephroid: empty: holds no run; expected a folder with run.json"));
  EXPECT_THAT(refusal({"file"}), HasSubstr("file: is a file; expected the folder of a run"));
  EXPECT_EQ(report({}).exit_code, 2);
  write_measured_run(folder / "run", "run", 3);
  EXPECT_THAT(refusal({"run", "./run/"}), HasSubstr("this run is named twice"));
  EXPECT_THAT(refusal({"run", "none"}), HasSubstr("none: there is no such folder"));
}

TEST_F(Reports, of_unfinished_runs_are_refused) {
  EXPECT_THAT(refusal_with_run_json("/finished", false),
              HasSubstr("run: this run is not finished: it stopped in pass 31"));
  fs::remove(folder / "run" / "run.json"); // as it is while a run is at work
  EXPECT_THAT(refusal({"run"}), HasSubstr("run: this run is not finished: it has no run.json"));
  write_measured_run(folder / "sweep" / "001", "run", 3);
  fs::rename(folder / "run", folder / "sweep" / "002");
  EXPECT_THAT(refusal({"sweep"}), HasSubstr("002: this run is not finished"));
}

TEST_F(Reports, of_damaged_runs_are_refused_at_the_place) {
  EXPECT_THAT(refusal_with("run.json", ""), HasSubstr("run/run.json: is empty"));
  EXPECT_THAT(refusal_with("run.json", made_run_json("run").dump().substr(0, 200)),
              HasSubstr("run/run.json: is cut or no JSON"));
  EXPECT_THAT(refusal_with("run.json", "[1]"), HasSubstr("run/run.json: is no object"));
  EXPECT_THAT(refusal_with("run.json", std::string(200000, '[')), HasSubstr("is nested deeper than 64 levels"));
  EXPECT_THAT(refusal_with("run.json", std::string("\0\xff\xfe", 3)), HasSubstr("is cut or no JSON"));
  EXPECT_THAT(refusal_with("run.json", "{}"), HasSubstr("run/run.json#/finished: is missing"));
  EXPECT_THAT(refusal_with_run_json("/passes", -1), HasSubstr("run.json#/passes: is no whole number from 0"));
  EXPECT_THAT(refusal_with_run_json("/device", "GPU"), HasSubstr("run.json#/device: is no object"));
  EXPECT_THAT(refusal_with_run_json("/work_seconds", nullptr), HasSubstr("run.json#/work_seconds: is no number"));
  EXPECT_THAT(refusal_with_run_json("/energy/lost_w", "much"), HasSubstr("run.json#/energy/lost_w: is no number"));
  EXPECT_THAT(refusal_with_run_json("/reference", Json::object()), HasSubstr("run.json#/reference/origin: is missing"));
  EXPECT_THAT(refusal_with("plan.json", R"({"engine": "spectral", "passes": [{"name": 1}]})"),
              HasSubstr("plan.json#/passes/0/name: is no text"));
  EXPECT_THAT(refusal_with("plan.json", R"({"engine": "spectral", "passes": 7})"),
              HasSubstr("plan.json#/passes: is no list"));
  EXPECT_THAT(refusal_with("preset.json", "7"), HasSubstr("preset.json: is no object"));
  EXPECT_THAT(refusal_with("history.csv", "seconds,wall_seconds,step,work,lab_mean\n1,1,1,1,0.5\n2,2,"),
              HasSubstr("history.csv:3: the row has 3 cells"));
  EXPECT_THAT(refusal_with("cooling.csv", "step,cost\n1,2\n2,x\n"), HasSubstr("cooling.csv:3: a cell is no number"));
  fs::remove(folder / "run" / "cooling.csv");
  EXPECT_THAT(refusal_with("image.exr", "not a picture"), HasSubstr("image.exr: is no picture that can be read"));
  fs::remove(folder / "run" / "image.exr");
  fs::remove(folder / "run" / "plan.json");
  EXPECT_THAT(refusal({"run"}), HasSubstr("run/plan.json: is missing"));
}

TEST_F(Reports, draw_what_they_can_of_extreme_histories) {
  write_measured_run(folder / "run", "run", 3);
  std::string history = "seconds,wall_seconds,step,work,lab_mean,mse\n0,0,0,0,1,1\n";
  for (const char* row : {"5e-324,1,1,1,1e308,5e-324", "1e-99,1,1,1,1e99,1e-99", "1,1,1,1,1,1e-99", "1,1,1,1,inf,",
                          "1e99,1,1,1,1e-99,1e99", "1e308,1,9223372036854775807,18446744073709551615,0,-1"})
    history += std::string(row) + "\n";
  write_file_whole(folder / "run" / "history.csv", history);
  const Ended ended = report({"run", "-o", "page.html"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read_file(folder / "page.html"), HasSubstr("[[1e-99,1e+99],[1.0,1.0],[1e+99,1e-99]]"));
}

/// A picture is only ever compared where it is finite; alone it is shown.
TEST_F(Reports, of_pictures_with_nan_are_refused_where_they_are_compared) {
  write_made_run(folder / "nan", made_run_json("nan"), {{"seed", 1}}, 4, 3, std::nanf(""));
  EXPECT_EQ(report({"nan"}).exit_code, 0);
  write_made_run(folder / "good", made_run_json("good"));
  EXPECT_THAT(refusal({"good", "nan"}), HasSubstr("nan/image.exr"));
}

TEST_F(Reports, of_too_many_runs_are_refused) {
  for (int i = 0; i <= 64; ++i)
    write_file_whole(
        (fs::create_directories(folder / "all" / std::to_string(i)), folder / "all" / std::to_string(i) / "run.json"),
        "{}");
  EXPECT_THAT(refusal({"all"}), HasSubstr("65 runs are too many for one page; expected at most 64"));
}

TEST_F(Reports, that_cannot_be_written_fail_in_one_line) {
  write_measured_run(folder / "run", "run", 3);
  for (const char* file : {"run", "none/page.html", "/proc/page.html"}) {
    const Ended ended = report({"run", "-o", file});
    EXPECT_EQ(ended.exit_code, 1) << file;
    EXPECT_THAT(ended.err, HasSubstr(std::string("nephroid: ") + file + ": cannot be written")) << file;
  }
}

/// What stands in the page once its scripts have run, as HTML; skips the test where there is no browser. Chromium is
/// not among the packages that the tests install: it is five times all others.
class ReportInBrowser : public Reports {
protected:
  std::string shown(const std::vector<std::string>& folders) const {
    std::vector<std::string> arguments = folders;
    arguments.insert(arguments.end(), {"-o", "page.html"});
    const Ended made = report(arguments);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const std::vector<std::string> browse{"--headless=new", "--no-sandbox",
                                          "--disable-gpu",  "--proxy-server=0",
                                          "--dump-dom",     "file://" + (folder / "page.html").string()};
    const std::string dom = Child(browse, folder, logs, {}, "chromium").wait().out;
    const std::size_t main = dom.find("<main>");
    return main == std::string::npos ? "" : dom.substr(main);
  }
  void SetUp() override {
    if (Child({"--version"}, folder, logs, {}, "chromium").wait().exit_code != 0)
      GTEST_SKIP() << "chromium is not installed";
  }
};

TEST_F(ReportInBrowser, shows_curves_tables_and_pictures) {
  write_measured_run(folder / "slow", "slow", 3, 0.1);
  write_measured_run(folder / "fast", "fast", 2, 0.1);
  const std::string html = shown({"slow", "fast"});
  for (const char* id : {"compared", "errors", "pictures", "plans", "machines"})
    EXPECT_THAT(html, HasSubstr(std::string("<section id=\"") + id + '"'));
  EXPECT_THAT(html, HasSubstr("17.0 s (5.0 %)")) << "of 323 s of work and 17 s of measuring";
  EXPECT_THAT(html, HasSubstr("aria-label=\"mean CIELAB distance against seconds of work\" width=\"")) << "drawn";
  EXPECT_THAT(html, AllOf(HasSubstr("<td class=\"number\">4.04 s</td><td class=\"number\">9.09 s</td>"),
                          HasSubstr("<strong>2.25 ×</strong>")))
      << "(2 / 1)^2 / (1 - 0.1^2)";
  EXPECT_THAT(html, AllOf(HasSubstr("floor 0.100"), HasSubstr("left out"),
                          HasSubstr("<th>photons</th><td class=\"number\">3 min 43 s</td>")));
  EXPECT_THAT(html, AllOf(HasSubstr("2 − 1"), HasSubstr("<img alt=\"fast\" src=\"data:image/png;base64,")));
}

TEST_F(ReportInBrowser, shows_what_files_say_as_text) {
  Json run_json = made_run_json("</script><img src=x onerror=alert(1)>");
  run_json["device"] = {{"name", "<b>bold</b>"}};
  run_json["sweeps"] = 17;
  run_json["inverse"] = {{"receivers", {{{"cost", 0.125}, {"<i>", nullptr}}}}};
  write_made_run(folder / "a", run_json);
  write_file_whole(
      folder / "a" / "plan.json",
      R"({"engine": "</main>", "passes": [{"name": "<b>", "runs": true, "reason": "<!--"}], "buffers": [], "defines": {}})");
  write_file_whole(folder / "a" / "cooling.csv", "step,<b>cost\n0,3\n1,2\n");
  const std::string html = shown({"a"});
  EXPECT_THAT(html, HasSubstr("<button aria-pressed=\"true\">cooling: &lt;b&gt;cost</button>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">17</td>"));
  EXPECT_THAT(html, HasSubstr("&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;"));
  EXPECT_THAT(html,
              AllOf(HasSubstr("&lt;b&gt;bold&lt;/b&gt;"), HasSubstr("<th>cost</th><td class=\"number\">0.125</td>")));
  for (const char* element : {"><img src=x", "><b>", "><i>", "><!--", ": <b>cost</b"})
    EXPECT_THAT(html, testing::Not(HasSubstr(element)));
}

} // namespace nephroid::report_test
