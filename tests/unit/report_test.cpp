// SPDX-License-Identifier: Apache-2.0
// The report over runs whose slopes, speed-ups and floors are known: its data, and the page that holds them.
// tests/hostile/report_test.cpp looks at it in a browser.
#include "report/report.h"
#include "tests/support/made_runs.h"

#include <regex>

namespace nephroid::report_test {

using report::Json;

class Report : public testing::Test {
protected:
  TemporaryFolder temporary;
  fs::path folder = temporary.path();

  std::vector<fs::path> folders(const std::vector<std::string>& names) const {
    std::vector<fs::path> all;
    for (const std::string& name : names) all.push_back(folder / name);
    return all;
  }
  Json data(const std::vector<std::string>& names) const { return report::report_data(folders(names)); }
  /// The metric that comes first.
  Json metric(const std::vector<std::string>& names) const { return data(names).at("metrics").at(0); }
  void write_history(const std::string& run, const std::vector<MadeColumn>& columns, int rows = 30) const {
    write_file_whole(folder / run / "history.csv", measure::to_csv(made_history(columns, rows)));
  }
};

/// The rows of the speed-up table: "faster < slower at error: seconds, seconds, speed-up", runs from 1 as the page
/// counts them.
std::vector<std::string> speed_ups(const Json& metric) {
  std::vector<std::string> rows;
  for (const Json& pair : metric.at("pairs"))
    rows.push_back(fmt::format("{} < {} at {:.3g}{}: {:.3g} s, {:.3g} s, {:.3g}", pair["faster"].get<int>() + 1,
                               pair["slower"].get<int>() + 1, pair["error"].get<double>(),
                               pair["estimate"] ? " (estimate)" : "", pair["faster_seconds"].get<double>(),
                               pair["slower_seconds"].get<double>(), pair["speed_up"].get<double>()));
  return rows;
}
std::string remark(const Json& metric) { return metric.at("pairs").at(0).at("remark"); }

TEST_F(Report, finds_the_slope_and_the_speed_up_of_known_curves) {
  write_measured_run(folder / "slow", "slow", 3);
  write_measured_run(folder / "fast", "fast", 2);
  const Json lab = metric({"slow", "fast"});
  EXPECT_EQ(lab.at("label"), "mean CIELAB distance");
  ASSERT_EQ(lab.at("lines").size(), 2u);
  for (const Json& line : lab.at("lines")) {
    EXPECT_NEAR(line.at("slope"), -0.5, 1e-9);
    EXPECT_EQ(line.at("points").size(), 30u);
  }
  // t = (factor / error)^2: at 0.5 after 16 s and 36 s, a speed-up of (3 / 2)^2. Rows go to 0.5 * 1.25^29 = 323 s,
  // errors of 0.167, 0.111.
  EXPECT_THAT(speed_ups(lab), ElementsAre("2 < 1 at 1: 4 s, 9 s, 2.25", "2 < 1 at 0.5: 16 s, 36 s, 2.25",
                                          "2 < 1 at 0.2: 100 s, 225 s, 2.25"));
}

TEST_F(Report, knows_when_each_run_came_to_a_round_error) {
  write_measured_run(folder / "slow", "slow", 3); // from 3 / sqrt(0.5) = 4.24 to 0.167
  write_measured_run(folder / "fast", "fast", 2); // from 2.83 to 0.111
  const Json lab = metric({"slow", "fast"});
  EXPECT_EQ(lab.at("levels"), Json({2.0, 1.0, 0.5, 0.2}));
  write_measured_run(folder / "late", "late", 0.5); // from 0.707 to 0.028
  const Json cells = metric({"slow", "late"}).at("times");
  const auto cell = [&](int run, int level) { return cells.at(run).at("cells").at(level); };
  ASSERT_EQ(metric({"slow", "late"}).at("levels"), Json({2.0, 1.0, 0.5, 0.2, 0.1, 0.05}));
  EXPECT_NEAR(cell(0, 0).at("seconds"), 2.25, 1e-9);
  EXPECT_FALSE(cell(0, 0).at("earlier"));
  EXPECT_TRUE(cell(0, 4).is_null()) << "never";
  EXPECT_TRUE(cell(1, 0).at("earlier")) << "below 2 at its first measurement";
  EXPECT_EQ(cell(1, 0).at("seconds"), 0.5);
  EXPECT_NEAR(cell(1, 5).at("seconds"), 100, 1e-9);
}

/// A browser loads nothing: the policy forbids it, and nothing of ours names an address.
TEST_F(Report, is_a_page_that_holds_all_it_needs) {
  write_measured_run(folder / "a", "a", 3, 0.1);
  const std::string html = report::report_html(folders({"a"}));
  EXPECT_THAT(html, AllOf(StartsWith("<!DOCTYPE html>"), EndsWith("</html>\n"), HasSubstr("Chart.js v"),
                          HasSubstr("Released under the MIT License"),
                          HasSubstr("content=\"default-src 'none'; img-src data:;"), Not(HasSubstr("{{"))));
  EXPECT_FALSE(std::regex_search(html.substr(0, html.find("Chart.js v")),
                                 std::regex("<(link|img|iframe)|@import|url\\(|src=|href=")));
  for (const report::PageFile& file : report::page_files())
    EXPECT_THAT(file.name == "chart.min.js" ? "" : file.text, AllOf(Not(HasSubstr("://")), Not(HasSubstr("innerHTML"))))
        << file.name;
}

/// What files say cannot end the element that holds the data, and is there as it was.
TEST_F(Report, holds_what_files_say_as_data) {
  write_measured_run(folder / "a", "x", 3);
  Json run_json = made_run_json("</script><script>alert(1)</script><!-- '\"&\\");
  run_json["device"]["name"] = "<script>alert(2)</script>";
  run_json["another"] = {{"engine's", {1, "<b>", nullptr}}};
  write_file_whole(folder / "a" / "run.json", run_json.dump());
  const std::string html = report::report_html(folders({"a"}));
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = html.find(begin) + begin.size();
  const Json embedded = Json::parse(html.substr(from, html.find('<', from) - from));
  EXPECT_EQ(embedded, data({"a"}));
  EXPECT_EQ(embedded.at("runs").at(0).at("run"), run_json);
}

TEST_F(Report, shows_the_noise_floor_and_does_not_compare_near_it) {
  write_measured_run(folder / "slow", "slow", 3, 0.4);
  write_measured_run(folder / "fast", "fast", 2, 0.4);
  const Json lab = metric({"slow", "fast"});
  EXPECT_EQ(lab.at("lines").at(0).at("floor"), 0.4);
  EXPECT_EQ(lab.at("levels"), Json({2.0, 1.0, 0.5}));
  EXPECT_TRUE(lab.at("times").at(0).at("cells").at(2).at("near_floor"));
  EXPECT_FALSE(lab.at("times").at(0).at("cells").at(1).at("near_floor"));
  // Both come down to 0.4, but below twice that the floor is a good part of the error: 1 is compared, 0.5 is not.
  // error^2 = f^2/t + .16
  EXPECT_THAT(speed_ups(lab), ElementsAre("2 < 1 at 2: 1.04 s, 2.34 s, 2.25", "2 < 1 at 1: 4.76 s, 10.7 s, 2.25"));
  // From three floors on the slope of the distance is -1/2 (1 - 1/9) or steeper
  EXPECT_LT(lab.at("lines").at(0).at("slope"), -0.44);
  EXPECT_GE(lab.at("lines").at(0).at("slope"), -0.50);
}

TEST_F(Report, never_compares_an_error_with_an_estimate) {
  write_measured_run(folder / "measured", "measured", 3);
  write_made_run(folder / "alone", made_run_json("alone"));
  write_history("alone", {{"estimated_lab_mean", 2}});
  const Json lab = metric({"measured", "alone"});
  EXPECT_TRUE(lab.at("lines").at(1).at("estimate"));
  EXPECT_NEAR(lab.at("lines").at(1).at("slope"), -0.5, 1e-9);
  EXPECT_THAT(speed_ups(lab), ElementsAre());
  EXPECT_EQ(lab.at("not_compared"), Json({"1 and 2 (one is measured against a reference, the other only estimated)"}));

  // With estimates of both there is something to compare: the estimates.
  write_history("measured", {{"lab_mean", 3}, {"estimated_lab_mean", 4}});
  EXPECT_EQ(speed_ups(metric({"measured", "alone"})).at(0), "2 < 1 at 2 (estimate): 1 s, 4 s, 4");
}

TEST_F(Report, warns_of_estimates_with_other_settings) {
  const auto write = [&](const char* name, double factor, const Json& spectral) {
    write_made_run(folder / name, made_run_json(name), {{"spectral", spectral}});
    write_history(name, {{"estimated_lab_mean", factor}});
  };
  write("fine", 3, {{"threshold_deg", 0.05}, {"photons_per_pass", 1000}});
  write("coarse", 2, {{"threshold_deg", 0.5}, {"photons_per_pass", 1000}});
  EXPECT_EQ(remark(metric({"fine", "coarse"})),
            "estimates do not see the bias of different settings: give both a reference");
  write("coarse", 2, {{"threshold_deg", 0.05}, {"photons_per_pass", 2000}}); // photons a pass are no bias
  EXPECT_EQ(remark(metric({"fine", "coarse"})), "");
  // Against references the bias is part of the error.
  for (const char* name : {"fine", "coarse"}) write_measured_run(folder / name, name, 3);
  write_file_whole(folder / "coarse" / "preset.json", R"({"spectral": {"threshold_deg": 0.5}})");
  EXPECT_EQ(remark(metric({"fine", "coarse"})), "");
}

TEST_F(Report, says_which_run_was_better_from_the_start) {
  write_measured_run(folder / "a", "a", 100); // down to 100 / sqrt(323) = 5.6
  write_measured_run(folder / "b", "b", 3);   // from 3 / sqrt(0.5) = 4.2
  EXPECT_EQ(metric({"a", "b"}).at("not_compared"),
            Json({"1 and 2 (2 was better at its first measurement than 1 ever was)"}));
  EXPECT_EQ(metric({"b", "a"}).at("not_compared"),
            Json({"1 and 2 (1 was better at its first measurement than 2 ever was)"}));
}

/// a goes from 7 to 5.90, b from 9 to 6.44: they have 6.44 .. 7 in common, whose middle is 6.71436.
TEST_F(Report, compares_at_three_figures_where_no_round_error_is_common) {
  for (const auto& [name, begin] : {std::pair{"a", 7.0}, std::pair{"b", 9.0}}) {
    write_measured_run(folder / name, name, 1);
    const double exponent = name == std::string("a") ? -0.026426 : -0.051712; // over a factor of 1.25^29 in time
    write_history(name, {{"lab_mean", begin / std::pow(0.5, exponent), exponent}});
  }
  const std::vector<std::string> rows = speed_ups(metric({"a", "b"}));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_THAT(rows[0], StartsWith("1 < 2 at 6.71: "));
}

/// error^2 = 2^2 / t + bias^2 against an estimate of 2 / sqrt(t): at the end, 323 s, noise is 0.11.
TEST_F(Report, says_where_noise_does_not_explain_the_error) {
  write_measured_run(folder / "a", "a", 2);
  const auto with_bias = [&](double bias) {
    write_history("a", {{"lab_mean", 2, -0.5, bias}, {"estimated_lab_mean", 2}});
    return metric({"a"}).at("biased");
  };
  EXPECT_EQ(with_bias(0), Json::array());
  EXPECT_EQ(with_bias(0.1), Json::array());
  EXPECT_EQ(with_bias(0.25), Json({0}));
}

TEST_F(Report, warns_of_other_scenes_devices_builds_and_references) {
  write_measured_run(folder / "a", "a", 3);
  write_measured_run(folder / "b", "b", 2, 0, "another.exr");
  EXPECT_EQ(remark(metric({"a", "b"})), "different references");
  write_measured_run(folder / "b", "b", 2);
  EXPECT_EQ(remark(metric({"a", "b"})), "");
  Json other = Json::parse(read_file(folder / "b" / "run.json"));
  other["device"]["name"] = "some GPU";
  other["commit"] = "1234567";
  write_file_whole(folder / "b" / "run.json", other.dump());
  EXPECT_EQ(remark(metric({"a", "b"})), "different devices, different builds of the program");
  write_file_whole(folder / "b" / "preset.json", R"({"seed": 1, "scene": {"lights": [{"power_w": 2}]}})");
  EXPECT_EQ(metric({"a", "b"}).at("pairs"), Json::array()) << "to another truth there is another way";
  EXPECT_THAT(metric({"a", "b"}).at("not_compared").at(0).get<std::string>(), StartsWith("1 and 2 (different scenes"));
  for (const char* key : {"white", "unit"}) {
    write_file_whole(folder / "b" / "preset.json", Json{{"seed", 1}, {key, 2}}.dump());
    EXPECT_EQ(metric({"a", "b"}).at("pairs"), Json::array()) << key;
  }
}

/// What an engine measures beside errors is a curve as well: no slope, no comparison, values of any sign; unless the
/// run is judged by it.
TEST_F(Report, shows_curves_of_any_name) {
  write_measured_run(folder / "a", "a", 3);
  write_history("a", {{"temperature", -7, 0.5}, {"cost", 5, -0.25}, {"psnr_db", 3, 0.1}, {"lab_mean", 3}});
  const Json metrics = data({"a"}).at("metrics");
  ASSERT_EQ(metrics.size(), 4u);
  EXPECT_EQ(metrics[0].at("metric"), "lab_mean") << "error against time comes first";
  const Json& temperature = metrics[1];
  EXPECT_EQ(temperature.at("label"), "temperature");
  EXPECT_EQ(temperature.at("lines").at(0).at("points").size(), 30u);
  EXPECT_TRUE(temperature.at("lines").at(0).at("slope").is_null());
  EXPECT_FALSE(temperature.at("falls") || temperature.at("larger_is_better") || temperature.contains("pairs"));
  EXPECT_TRUE(metrics[3].at("larger_is_better")) << "psnr_db";

  Json run_json = made_run_json("a");
  run_json["error_column"] = "cost";
  write_file_whole(folder / "a" / "run.json", run_json.dump());
  const Json cost = metric({"a"});
  EXPECT_EQ(cost.at("metric"), "cost");
  EXPECT_TRUE(cost.at("falls"));
  EXPECT_NEAR(cost.at("lines").at(0).at("slope"), -0.25, 1e-9);
}

/// job::Curve
TEST_F(Report, holds_the_curves_that_an_engine_adds) {
  write_made_run(folder / "a", made_run_json("a"));
  write_file_whole(folder / "a" / "cooling.csv", "step,temperature,cost\n0,10.5,nan\n1,2e-3,4\n");
  const Json curve = data({"a"}).at("runs").at(0).at("curves").at(0);
  EXPECT_EQ(curve.dump(),
            R"({"name":"cooling","columns":["step","temperature","cost"],"rows":[[0.0,10.5,null],[1.0,0.002,4.0]]})");
}

/// The kinds of a group's pictures with their runs: "run 0, run 1, reference 0 1, difference 0".
std::string kinds(const Json& group) {
  std::string words;
  for (const Json& picture : group.at("pictures")) {
    words += (words.empty() ? "" : ", ") + picture.at("kind").get<std::string>();
    for (const int run : picture.at("runs")) words += fmt::format(" {}", run);
    if (!picture.at("from").is_null()) words += fmt::format(" from {}", picture.at("from").get<int>());
  }
  return words;
}

/// Two files with one picture are one reference.
TEST_F(Report, knows_references_by_their_pictures) {
  float value = 0.4f;
  for (const char* name : {"one.exr", "two.exr"})
    image::write_exr(folder / name, {4, 3, {"R", "G", "B"}, std::vector<float>(36, value += 0.1f), {}});
  fs::copy_file(folder / "one.exr", folder / "copy.exr");
  write_measured_run(folder / "a", "a", 3, 0, (folder / "one.exr").string());
  write_measured_run(folder / "b", "b", 2, 0, (folder / "two.exr").string());
  write_measured_run(folder / "c", "c", 2, 0, (folder / "copy.exr").string());
  EXPECT_EQ(kinds(data({"a", "b", "c"}).at("pictures").at(0)),
            "run 0, run 1, run 2, reference 0 2, reference 1, difference 0, difference 1, difference 2");
  EXPECT_EQ(kinds(data({"a", "c"}).at("pictures").at(0)), "run 0, run 1, reference 0 1, difference 0, difference 1");
  EXPECT_EQ(remark(metric({"a", "c"})), "");
  EXPECT_EQ(remark(metric({"a", "b"})), "different references");
}

TEST_F(Report, takes_a_sweep_as_its_runs) {
  for (const char* seed : {"1", "2", "3"}) {
    const fs::path run = folder / "sweep" / ("00" + std::string(seed));
    write_measured_run(run, "plate,seed=" + std::string(seed), 3);
    write_file_whole(run / "preset.json",
                     Json{{"seed", std::stoi(seed)}, {"scene", {{"lights", {{{"power_w", 2}}}}}}}.dump());
  }
  const Json sweep = data({"sweep"});
  EXPECT_EQ(sweep.at("title"), "plate: 3 runs");
  EXPECT_EQ(sweep.at("runs").at(2).at("label"), "seed=3"); // the part of the name that differs
  EXPECT_EQ(sweep.at("runs").at(2).at("settings"), Json({{"scene.lights.0.power_w", "2"}, {"seed", "3"}}));
  EXPECT_EQ(data({"sweep/001"}).at("title"), "plate,seed=1");
  // In the sweep's order, without what an earlier one left.
  write_file_whole(folder / "sweep" / "sweep.json", R"({"runs": ["003", "not yet", "001"]})");
  EXPECT_EQ(data({"sweep"}).at("runs").size(), 2u);
  EXPECT_EQ(data({"sweep"}).at("runs").at(0).at("label"), "seed=3");
}

TEST_F(Report, says_what_is_not_there) {
  write_made_run(folder / "none", made_run_json("none"));
  EXPECT_EQ(data({"none"}).at("metrics"), Json::array());
  EXPECT_TRUE(data({"none"}).at("runs").at(0).at("measurements").is_null());
  write_made_run(folder / "zero", made_run_json("zero"));
  write_history("zero", {{"lab_mean"}}, 0);
  EXPECT_EQ(data({"zero"}).at("metrics"), Json::array());
  EXPECT_EQ(data({"zero"}).at("runs").at(0).at("measurements"), 0);
  write_measured_run(folder / "one", "one", 3);
  write_history("one", {{"lab_mean"}}, 1);
  EXPECT_TRUE(metric({"one"}).at("lines").at(0).at("slope").is_null());
  EXPECT_EQ(data({"one"}).at("notes"), Json({"The reference reference.exr is not there any more."}));
  fs::remove(folder / "one" / "image.exr");
  EXPECT_THAT(data({"one"}).at("notes").at(1).get<std::string>(), EndsWith("image.exr is missing."));
  EXPECT_EQ(data({"one"}).at("pictures"), Json::array());
}

TEST_F(Report, groups_pictures_by_name_and_size) {
  write_made_run(folder / "a", made_run_json("a"), {{"seed", 1}}, 4, 3, 0.5f);
  write_made_run(folder / "b", made_run_json("b"), {{"seed", 2}}, 4, 3, 0.25f);
  write_made_run(folder / "c", made_run_json("c"), {{"seed", 1}}, 5, 3);
  for (const char* run : {"a", "c"})
    image::write_exr(folder / run / "receiver_1.exr", {2, 1, {"R", "G", "B"}, std::vector<float>(6, 0.4f), {}});
  const Json groups = data({"a", "b", "c"}).at("pictures");
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].at("name"), "image");
  EXPECT_EQ(kinds(groups[0]), "run 0, run 1, difference 1 from 0");
  EXPECT_EQ(groups[1].at("name"), "receiver_1");
  EXPECT_EQ(kinds(groups[1]), "run 0, run 2, difference 2 from 0");
  EXPECT_EQ(groups[2].at("width"), 5);
  EXPECT_EQ(kinds(groups[2]), "run 2");
}

/// By the alphabet of RFC 4648.
std::string decoded_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8));
  }
  EXPECT_EQ(text.size(), (bytes.size() + 2) / 3 * 4) << "filled up with =";
  return bytes;
}

/// The embedded picture is what a display shows of the linear one.
TEST_F(Report, embeds_pictures_as_shown) {
  write_made_run(folder / "a", made_run_json("a"));
  write_file_whole(folder / "a.png", decoded_base64(data({"a"}).at("pictures").at(0).at("pictures").at(0).at("png")));
  const image::Image picture = image::read_image(folder / "a.png");
  EXPECT_EQ(picture.width, 4);
  EXPECT_EQ(picture.height, 3);
  for (const float value : picture.data) EXPECT_NEAR(value, 188 / 255.0, 1e-6); // sRGB of 0.5 is 187.5
}

} // namespace nephroid::report_test
