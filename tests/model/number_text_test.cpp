#include "model/output/number_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cmath>
#include <limits>

#include "tests/support/environment.h"
#include "tests/support/german_locale.h"

namespace halyard {
namespace {

TEST(NumberText, IsThatOfPrintf) {
  EXPECT_EQ(with_digits(1234.5678, 6), "1234.57");
  EXPECT_EQ(with_digits(1234.5678, 3), "1.23e+03");
  EXPECT_EQ(with_digits(2, 6), "2");
  EXPECT_EQ(with_decimals(-0.0125, 3), "-0.013");  // the double is a little above 0.0125
  EXPECT_EQ(with_decimals(2, 3), "2.000");
  EXPECT_EQ(with_decimals(-std::numeric_limits<double>::max(), 6).size(), 1u + 309 + 1 + 6);
}

TEST(NumberText, ReadBackIsTheRoundedNumber) {
  EXPECT_EQ(rounded_to_digits(0.123456, 4), 0.1235);
  EXPECT_EQ(rounded_to_digits(-9.99996e-300, 4), -1e-299);
  EXPECT_EQ(rounded_to_decimals(0.98765, 3), 0.988);
  EXPECT_TRUE(std::isnan(rounded_to_digits(std::nan(""), 4)));
  constexpr double kLargest = std::numeric_limits<double>::max();  // in four digits there is no such double
  EXPECT_EQ(rounded_to_digits(kLargest, 4), kLargest);
}

TEST(NumberText, IsTheSameInALocaleWithDecimalCommas) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("german-locale-" + std::to_string(::getpid()));
  if (!make_german_locale(folder)) GTEST_SKIP() << kNoGermanLocale;
  const Environment there("LOCPATH", folder.string());
  ASSERT_NE(std::setlocale(LC_NUMERIC, kGermanLocale), nullptr);
  EXPECT_EQ(std::stod("0.5"), 0) << "the locale has no effect";
  EXPECT_EQ(with_digits(1234.5678, 6), "1234.57");
  EXPECT_EQ(with_decimals(2, 3), "2.000");
  EXPECT_EQ(rounded_to_digits(0.123456, 4), 0.1235);
  EXPECT_EQ(rounded_to_decimals(0.98765, 3), 0.988);
  std::setlocale(LC_NUMERIC, "C");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace halyard
