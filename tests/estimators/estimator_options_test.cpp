/// Options of estimators: ranges that include their ends, numbers of one joint or of each, and what is left over.

#include "estimators/estimator_options.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/message_of.h"

namespace halyard {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

TEST(EstimatorOptions, ANumberAtEitherEndOfItsRangeIsTaken) {
  for (const auto& [text, taken] : std::map<std::string, bool>{{"-1", true},
                                                               {"2", true},
                                                               {" 0.5 ", true},
                                                               {"-1.001", false},
                                                               {"2.001", false},
                                                               {"nan", false},
                                                               {"", false},
                                                               {"1 1", false}}) {
    const EstimatorOptions options = {{"level", text}};
    OptionReader reader("test", options);
    if (taken) {
      EXPECT_EQ(reader.number("level", 7, -1, 2), std::stod(text)) << text;
    } else {
      EXPECT_EQ(message_of([&] { reader.number("level", 7, -1, 2); }),
                "estimator test: option level = '" + text +
                    "': expected a number from -1 to 2; correct it, or leave the option out");
    }
  }
}

TEST(EstimatorOptions, OneNumberIsForAllJointsAndMoreForEach) {
  const Eigen::Vector3d standard(1, 2, 3);
  const EstimatorOptions options = {{"all", "0.5"},    {"each", " 4 5\t6"}, {"two", "4 5"}, {"low", "1 0 1"},
                                    {"high", "1 9 1"}, {"ends", "0.5 8 1"}, {"none", " "}};
  const auto read = [&](const std::string& name) {
    OptionReader reader("test", options);
    return reader.per_joint(name, standard, 0.5, 8);
  };
  EXPECT_EQ(read("absent"), standard);
  EXPECT_EQ(read("all"), Eigen::Vector3d::Constant(0.5));
  EXPECT_EQ(read("each"), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(read("ends"), Eigen::Vector3d(0.5, 8, 1));
  for (const std::string name : {"two", "low", "high", "none"})
    EXPECT_EQ(message_of([&] { read(name); }),
              "estimator test: option " + name + " = '" + options.at(name) +
                  "': expected one number, or one for each of the 3 joints with blanks between, from 0.5 to 8; correct "
                  "it, or leave the option out");
}

TEST(EstimatorOptions, WhatNobodyReadIsRefusedAndTheKnownListed) {
  const EstimatorOptions options = {{"gate", "1"}, {"gait", "1"}};
  OptionReader reader("test", options);
  EXPECT_EQ(message_of([&] { reader.finish(); }), "estimator test: unknown option 'gait'; it has no options");
  reader.number("gate", 0, 0, kNoEnd);
  reader.number("lag", 0, 0, kNoEnd);
  EXPECT_EQ(message_of([&] { reader.finish(); }), "estimator test: unknown option 'gait'; known are gate, lag");
  reader.number("gait", 0, 0, kNoEnd);
  EXPECT_EQ(message_of([&] { reader.finish(); }), "no InputError");
}

}  // namespace
}  // namespace halyard
