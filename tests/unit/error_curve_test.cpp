// SPDX-License-Identifier: Apache-2.0
// Slopes, times to an error and speed-ups on curves whose answers are known in closed form. history.csv: what is
// written is read back with the same bits, and what is no whole history is refused at its line.
#include "measure/run_curves.h"
#include "measure/run_files.h"
#include "tests/support/test.h"

namespace nephroid::error_curve_test {

using namespace nephroid::measure;

/// error = factor t^exponent at times first * ratio^i.
Curve power_curve(double factor, double exponent, double first, double ratio, int points) {
  Curve curve;
  for (int i = 0; i < points; ++i) {
    curve.seconds.push_back(first * std::pow(ratio, i));
    curve.errors.push_back(factor * std::pow(curve.seconds.back(), exponent));
  }
  return curve;
}

TEST(RunCurves, leave_out_what_cannot_be_drawn) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  nephroid::job::History history{.columns = {"lab_mean", "psnr_db", "estimated_lab_mean"}};
  const double errors[] = {1, nan, infinity, 0, -1, 2, 1e300, 5e-324};
  for (int i = 0; i < 8; ++i) history.rows.push_back({static_cast<double>(i), 0, i, 0, {errors[i], errors[i]}});
  const RunCurves error = run_curves(history, "lab_mean", true), quality = run_curves(history, "psnr_db", false);
  EXPECT_THAT(error.error.seconds, ElementsAre(5));
  EXPECT_THAT(error.error.errors, ElementsAre(2));
  EXPECT_TRUE(error.estimate.errors.empty()) << "no row has the cell";
  EXPECT_THAT(quality.error.seconds, ElementsAre(3, 4, 5, 7)) << "its axis is linear";
}

TEST(Slope, of_a_power_law_is_its_exponent) {
  for (const double exponent : {-0.5, -1.0, -0.25, 0.0, 0.5}) {
    const auto law = fit_power_law(power_curve(3, exponent, 0.2, 1.3, 20));
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, exponent, 1e-12);
    EXPECT_NEAR(law->factor, 3, 1e-11);
    EXPECT_EQ(law->points, 20u);
  }
}

/// A hundred rows within the last hundredth of the time must not outweigh the four decades before them. By hand: with x
/// = log10 t the rows at 0, 1, 2, 3 lie on y = -x / 2 and the crowd at 4 lies 1 above it. The crowd's weight is that of
/// one end row, 1/2 of 4 in all: mean x = (0/2 + 1 + 2 + 3 + 4/2) / 4 = 2, sum w (x - 2)^2 = 2 + 1 + 0 + 1 + 2 = 6, sum
/// w (x - 2) dy = 1/2 * 2 * 1 = 1, so that the slope is -1/2 + 1/6.
TEST(Slope, counts_equal_parts_of_the_log_axis_equally) {
  Curve curve = power_curve(1, -0.5, 1, 10, 4);
  for (int i = 0; i < 100; ++i) {
    curve.seconds.push_back(10000 * (1 + 1e-9 * i));
    curve.errors.push_back(10 / std::sqrt(10000.0));
  }
  EXPECT_THAT(fit_power_law(curve)->exponent, DoubleNear(-0.5 + 1.0 / 6, 1e-6));
}

TEST(Slope, ends_where_it_is_told_to) {
  // error^2 = 1/t + floor^2: bends to the floor, and above 3 floors the slope between two points is at worst -1/2 (1 -
  // 1/9)
  constexpr double floor = 0.01;
  Curve curve;
  for (double t = 1; t < 1e7; t *= 1.2) {
    curve.seconds.push_back(t);
    curve.errors.push_back(std::sqrt(1 / t + floor * floor));
  }
  EXPECT_GT(fit_power_law(curve)->exponent, -0.4);
  const double above = fit_power_law(curve, 3 * floor)->exponent;
  EXPECT_LT(above, -0.5 * (1 - 1.0 / 9));
  EXPECT_GT(above, -0.5);
}

TEST(Slope, needs_four_points_and_a_factor_of_two) {
  EXPECT_FALSE(fit_power_law({}));
  EXPECT_FALSE(fit_power_law(power_curve(1, -0.5, 1, 2, 3)));
  EXPECT_TRUE(fit_power_law(power_curve(1, -0.5, 1, 2, 4)));
  EXPECT_FALSE(fit_power_law(power_curve(1, -0.5, 1, 1.2, 4))); // to 1.73
  EXPECT_FALSE(fit_power_law(power_curve(1, -0.5, 1, 1, 9)));   // all at one time
  EXPECT_FALSE(fit_power_law(power_curve(1, -0.5, 1, 2, 4), 0.6));
}

TEST(TimeToReach, is_exact_on_a_power_law) {
  const Curve curve = power_curve(2, -0.5, 0.1, 1.37, 30); // t = (2 / e)^2
  for (const double error : {6.0, 1.0, 0.5, 0.123})
    EXPECT_NEAR(*seconds_to_reach(curve, error), 4 / (error * error), 1e-9 / (error * error));
}

TEST(TimeToReach, is_the_first_time_and_only_within_the_curve) {
  const Curve curve{{1, 2, 4, 8, 16}, {1, 0.5, 0.8, 0.25, 0.25}};
  EXPECT_DOUBLE_EQ(*seconds_to_reach(curve, 1), 1);
  EXPECT_DOUBLE_EQ(*seconds_to_reach(curve, 0.5), 2); // not at about 5, when it falls there for the second time
  EXPECT_DOUBLE_EQ(*seconds_to_reach(curve, 0.25), 8);
  EXPECT_FALSE(seconds_to_reach(curve, 0.2)); // never
  EXPECT_FALSE(seconds_to_reach(curve, 1.1)); // before the first point
  EXPECT_FALSE(seconds_to_reach({}, 1));
  EXPECT_DOUBLE_EQ(*seconds_to_reach({{3}, {1}}, 1), 3); // a single row
}

TEST(SpeedUp, of_two_power_laws_is_the_square_of_their_ratio) {
  // 3 / sqrt(t) and 2 / sqrt(t) are at one error at times of which one is (3/2)^2 times the other
  const Curve slow = power_curve(3, -0.5, 0.5, 1.21, 50), fast = power_curve(2, -0.5, 0.4, 1.33, 40);
  for (const double error : {2.5, 1.0, 0.1}) {
    const auto equal = at_equal_error(slow, fast, error);
    ASSERT_TRUE(equal);
    EXPECT_NEAR(equal->speed_up(), 2.25, 1e-9);
    EXPECT_NEAR(equal->seconds_b, 4 / (error * error), 1e-9 / (error * error));
    EXPECT_NEAR(at_equal_error(fast, slow, error)->speed_up(), 1 / 2.25, 1e-9);
  }
  EXPECT_FALSE(at_equal_error(slow, fast, 4)); // the first point of slow is 4.24, of fast 3.16
}

TEST(ErrorRange, is_what_both_curves_came_down_to) {
  const Curve a{{1, 2, 4}, {8, 4, 2}}, b{{1, 2, 4}, {5, 3, 1}}, above{{1, 2}, {100, 50}};
  EXPECT_DOUBLE_EQ(errors_both_reached(a, b)->lowest, 2);
  EXPECT_DOUBLE_EQ(errors_both_reached(a, b)->highest, 5);
  EXPECT_DOUBLE_EQ(errors_both_reached(a, b, 3)->lowest, 3);
  EXPECT_FALSE(errors_both_reached(a, b, 6));
  EXPECT_FALSE(errors_both_reached(a, above));
  EXPECT_FALSE(errors_both_reached(a, {}));
}

TEST(RoundLevels, are_one_two_five) {
  EXPECT_THAT(round_levels(0.09, 2), ElementsAre(2, 1, 0.5, 0.2, 0.1));
  EXPECT_THAT(round_levels(0.1, 0.1), ElementsAre(0.1)); // bounds included
  EXPECT_THAT(round_levels(1e-7, 3e-7), ElementsAre(2e-7, 1e-7));
  EXPECT_THAT(round_levels(3, 4), ElementsAre());
  EXPECT_THAT(round_levels(2000, 7000), ElementsAre(5000, 2000));
  EXPECT_THAT(round_levels(0, 1), ElementsAre());
  EXPECT_THAT(round_levels(std::nan(""), 1), ElementsAre());
}

job::History three_rows() {
  job::History history{.columns = {"lab_mean", "psnr_db", "estimated_lab_mean"}};
  history.rows = {{0.25, 0.5, 1, 262144, {1.5, 20.25, 1.25}},
                  {0.5, 1.125, 2, 524288, {1, std::nan(""), 0.75}},
                  {0.5, 1.25, 2, 524288, {0.5, std::numeric_limits<double>::infinity(), -0.0}}};
  return history;
}

/// Bit for bit, and NaN equals NaN.
bool same(double a, double b) { return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b); }

void expect_same(const job::History& a, const job::History& b) {
  EXPECT_EQ(a.columns, b.columns);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t row = 0; row < a.rows.size(); ++row) {
    EXPECT_TRUE(same(a.rows[row].seconds, b.rows[row].seconds));
    EXPECT_TRUE(same(a.rows[row].wall_seconds, b.rows[row].wall_seconds));
    EXPECT_EQ(a.rows[row].step, b.rows[row].step);
    EXPECT_EQ(a.rows[row].work, b.rows[row].work);
    ASSERT_EQ(a.rows[row].errors.size(), b.rows[row].errors.size());
    for (std::size_t i = 0; i < a.rows[row].errors.size(); ++i)
      EXPECT_TRUE(same(a.rows[row].errors[i], b.rows[row].errors[i])) << "row " << row << " column " << i;
  }
}

class HistoryFile : public testing::Test {
protected:
  test::TemporaryFolder temporary;
  fs::path folder = temporary.path();

  job::History read(const std::string& text) {
    write_file_whole(folder / "history.csv", text);
    return measure::read_history(folder / "history.csv");
  }

  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { read(text); });
  }
};

TEST_F(HistoryFile, is_the_contracts_text) {
  EXPECT_EQ(measure::to_csv(three_rows()), "seconds,wall_seconds,step,work,lab_mean,psnr_db,estimated_lab_mean\n"
                                           "0.25,0.5,1,262144,1.5,20.25,1.25\n"
                                           "0.5,1.125,2,524288,1,,0.75\n"
                                           "0.5,1.25,2,524288,0.5,inf,-0\n");
}

TEST_F(HistoryFile, comes_back_as_it_was) {
  expect_same(read(measure::to_csv(three_rows())), three_rows());
  expect_same(read(measure::to_csv({})), {}); // of a run that measured nothing
  job::History no_rows{.columns = {"mse"}};
  expect_same(read(measure::to_csv(no_rows)), no_rows);
}

/// Doubles of every magnitude: random bits, the largest, the smallest and a subnormal number.
TEST_F(HistoryFile, keeps_every_bit) {
  std::mt19937_64 bits(7);
  job::History history{.columns = {"a", "b", "c"}};
  double clock = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> errors(3);
    for (double& error : errors) {
      const std::uint64_t word = bits();
      std::memcpy(&error, &word, sizeof error);
    }
    clock += std::generate_canonical<double, 53>(bits);
    history.rows.push_back({clock, 1.1 * clock, std::int64_t(bits() >> 1), bits(), errors});
  }
  using Limits = std::numeric_limits<double>;
  history.rows.push_back({clock, Limits::max(), 0, 0, {Limits::max(), Limits::min(), Limits::denorm_min()}});
  expect_same(read(measure::to_csv(history)), history);
}

/// Of a file that ends too early only a beginning that ends with a line is a history: of fewer rows, which nothing can
/// tell.
TEST_F(HistoryFile, a_cut_file_is_refused_wherever_it_is_cut) {
  const std::string whole = measure::to_csv(three_rows());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string cut = whole.substr(0, length);
    if (!cut.empty() && cut.back() == '\n')
      EXPECT_NO_THROW(read(cut)) << length;
    else
      EXPECT_THAT(refusal(cut), HasSubstr("history.csv")) << length;
  }
}

TEST_F(HistoryFile, a_wrong_first_line_is_refused) {
  EXPECT_THAT(refusal(""), HasSubstr("the file is empty"));
  EXPECT_THAT(refusal("\n"), HasSubstr(":1: this is no history of a run; expected 'seconds,wall_seconds,step,work'"));
  EXPECT_THAT(refusal("seconds,step,work,mse\n"), HasSubstr("no history"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,\n"), HasSubstr(":1: column 5 has the name ''"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,mse,mse\n"), HasSubstr(":1: two columns have the name 'mse'"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,seconds\n"),
              HasSubstr(":1: two columns have the name 'seconds'"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,<b>\n"), HasSubstr("the name '<b>'"));
  EXPECT_THAT(refusal(std::string("\0\x89PNG\r\n\x1a\n\xff", 11)), HasSubstr("no history"));
}

TEST_F(HistoryFile, a_wrong_row_is_refused_at_its_line) {
  const std::string head = "seconds,wall_seconds,step,work,mse\n0.5,1,1,10,0.25\n";
  const auto refused = [&](const std::string& row) { return refusal(head + row + "\n"); };
  EXPECT_THAT(refused("1,2,2,20"), HasSubstr("history.csv:3: the row has 4 cells; expected 5"));
  EXPECT_THAT(refused("1,2,2,20,.1,.1"), HasSubstr(":3: the row has 6 cells"));
  EXPECT_THAT(refused(""), HasSubstr(":3: the row has 1 cell;"));
  EXPECT_THAT(refused("one,2,2,20,.1"), HasSubstr(":3: seconds 'one' is no number"));
  EXPECT_THAT(refused(",2,2,20,.1"), HasSubstr("seconds '' is no number"));
  EXPECT_THAT(refused("1 ,2,2,20,.1"), HasSubstr("seconds '1 ' is no number"));
  EXPECT_THAT(refused("1,2,2.5,20,.1"), HasSubstr("step '2.5' is no number"));
  EXPECT_THAT(refused("1,2,2,-20,.1"), HasSubstr("work '-20' is no number"));
  EXPECT_THAT(refused("1,2,2,99999999999999999999,.1"), HasSubstr("is no number"));
  EXPECT_THAT(refused("1,2,2,20,1e999"), HasSubstr("mse '1e999' is no number"));
  EXPECT_THAT(refused("1,2,2,20,nan"), HasSubstr("mse is nan; an undefined error is an empty cell"));
  EXPECT_THAT(refused("nan,2,2,20,.1"), HasSubstr("seconds is nan"));
  EXPECT_THAT(refused("inf,2,2,20,.1"), HasSubstr("seconds is inf"));
  EXPECT_THAT(refused("1,-2,2,20,.1"), HasSubstr("wall_seconds is -2"));
  EXPECT_THAT(refused("0.25,2,2,20,.1"), HasSubstr(":3: seconds fall from 0.5 to 0.25"));
  EXPECT_THAT(refused("1,2,2,20,\x1b[31m\x01" + std::string(10000, 'x')), HasSubstr("mse '?[31m?xxx"));
  EXPECT_LT(refused("1,2,2,20," + std::string(10000, 'x')).size(), 400u);
}

TEST_F(HistoryFile, what_is_no_file_is_refused) {
  EXPECT_THAT(test::refusal_of([&] { measure::read_history(folder / "none.csv"); }), HasSubstr("cannot be read"));
  EXPECT_THAT(test::refusal_of([&] { measure::read_history(folder); }), HasSubstr("it is a folder"));
  write_file_whole(folder / "huge.csv", "");
  fs::resize_file(folder / "huge.csv", std::uintmax_t(1) << 40); // takes no room on the disk
  EXPECT_THAT(test::refusal_of([&] { measure::read_history(folder / "huge.csv"); }), HasSubstr("has 1048576 MiB"));
}

} // namespace nephroid::error_curve_test
