// SPDX-License-Identifier: Apache-2.0
// history.csv: what is written is read back with the same bits, and what is no whole history is refused at its line.
#include "measure/history_file.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

namespace nephroid::history_file_test {

job::History three_rows()
{
  job::History history;
  history.columns = {"lab_mean", "psnr_db", "estimated_lab_mean"};
  history.rows = {{0.25, 0.5, 1, 262144, {1.5, 20.25, 1.25}},
                  {0.5, 1.125, 2, 524288, {1, std::nan(""), 0.75}},
                  {0.5, 1.25, 2, 524288, {0.5, std::numeric_limits<double>::infinity(), -0.0}}};
  return history;
}

/// Bit for bit, and NaN equals NaN.
bool same(double a, double b) { return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b); }

void expect_same(const job::History& a, const job::History& b)
{
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

class HistoryFile : public ::testing::Test {
protected:
  test::TemporaryFolder temporary;
  std::filesystem::path folder = temporary.path();

  job::History read(const std::string& text)
  {
    write_file_whole(folder / "history.csv", text);
    return measure::read_history(folder / "history.csv");
  }

  std::string refusal(const std::string& text)
  {
    return test::refusal_of([&] { read(text); });
  }
};

TEST_F(HistoryFile, is_the_contracts_text)
{
  EXPECT_EQ(measure::to_csv(three_rows()), "seconds,wall_seconds,step,work,lab_mean,psnr_db,estimated_lab_mean\n"
                                           "0.25,0.5,1,262144,1.5,20.25,1.25\n"
                                           "0.5,1.125,2,524288,1,,0.75\n"
                                           "0.5,1.25,2,524288,0.5,inf,-0\n");
}

TEST_F(HistoryFile, comes_back_as_it_was)
{
  expect_same(read(measure::to_csv(three_rows())), three_rows());
  expect_same(read(measure::to_csv({})), {}); // of a run that measured nothing
  job::History no_rows;
  no_rows.columns = {"mse"};
  expect_same(read(measure::to_csv(no_rows)), no_rows);
}

/// Doubles of every magnitude: random bits, the largest, the smallest and a subnormal number.
TEST_F(HistoryFile, keeps_every_bit)
{
  std::mt19937_64 bits(7);
  job::History history;
  history.columns = {"a", "b", "c"};
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

/// Of a file that ends too early only a beginning that ends with a line is a history: of fewer rows, which nothing can tell.
TEST_F(HistoryFile, a_cut_file_is_refused_wherever_it_is_cut)
{
  const std::string whole = measure::to_csv(three_rows());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string cut = whole.substr(0, length);
    if (!cut.empty() && cut.back() == '\n')
      EXPECT_NO_THROW(read(cut)) << length;
    else
      EXPECT_THAT(refusal(cut), HasSubstr("history.csv")) << length;
  }
}

TEST_F(HistoryFile, a_wrong_first_line_is_refused)
{
  EXPECT_THAT(refusal(""), HasSubstr("the file is empty"));
  EXPECT_THAT(refusal("\n"), HasSubstr(":1: this is no history of a run; expected 'seconds,wall_seconds,step,work'"));
  EXPECT_THAT(refusal("seconds,step,work,mse\n"), HasSubstr("no history"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,\n"), HasSubstr(":1: column 5 has the name ''"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,mse,mse\n"), HasSubstr(":1: two columns have the name 'mse'"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,seconds\n"), HasSubstr(":1: two columns have the name 'seconds'"));
  EXPECT_THAT(refusal("seconds,wall_seconds,step,work,<b>\n"), HasSubstr("the name '<b>'"));
  EXPECT_THAT(refusal(std::string("\0\x89PNG\r\n\x1a\n\xff", 11)), HasSubstr("no history"));
}

TEST_F(HistoryFile, a_wrong_row_is_refused_at_its_line)
{
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

TEST_F(HistoryFile, what_is_no_file_is_refused)
{
  EXPECT_THAT(test::refusal_of([&] { measure::read_history(folder / "none.csv"); }), HasSubstr("cannot be read"));
  EXPECT_THAT(test::refusal_of([&] { measure::read_history(folder); }), HasSubstr("it is a folder"));
  write_file_whole(folder / "huge.csv", "");
  std::filesystem::resize_file(folder / "huge.csv", std::uintmax_t(1) << 40); // takes no room on the disk
  EXPECT_THAT(test::refusal_of([&] { measure::read_history(folder / "huge.csv"); }), HasSubstr("has 1048576 MiB"));
}

} // namespace nephroid::history_file_test
