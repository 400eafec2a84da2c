#pragma once
/// The nonlinear problems of NIST's Statistical Reference Datasets: data, start values and certified results, as
/// lower.txt, average.txt and higher.txt have them, one file for each level of difficulty.
///
/// Source: https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml. The data and the certified parameters give the
/// certified sums of squares (NistProblems.HaveTheirCertifiedSumsOfSquares).
///
///   problem NAME
///   start_1, start_2   start values: far from the solution, near it
///   certified          parameters of the least sum of squares, to 11 digits
///   squares            that sum
///   y, x, x_2          observations and predictors; 1..250 stands for 1 2 3 ... 250

#include <cctype>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace halyard {

struct NistProblem {
  std::string level, name;
  std::map<std::string, std::vector<double>> numbers;  ///< by the keys above

  const std::vector<double>& operator[](const std::string& key) const { return numbers.at(key); }
  double x(std::size_t i) const { return numbers.at("x")[i]; }
  /// The second predictor; 0 where there is one.
  double x_2(std::size_t i) const {
    const auto found = numbers.find("x_2");
    return found == numbers.end() ? 0 : found->second[i];
  }
};

/// Appends "3.5" or "1..250".
inline void add_numbers(const std::string& word, std::vector<double>& numbers) {
  const std::size_t dots = word.find("..");
  if (dots == word.npos) return numbers.push_back(std::stod(word));
  const int first = std::stoi(word), last = std::stoi(word.substr(dots + 2));
  numbers.resize(numbers.size() + last - first + 1);
  std::iota(numbers.end() - (last - first + 1), numbers.end(), first);
}

inline std::vector<NistProblem> read_nist_problems() {
  std::vector<NistProblem> all;
  for (const char* level : {"lower", "average", "higher"}) {
    std::ifstream file(std::string(HALYARD_SOURCE_DIR "/tests/diagnosis/fit/nist/") + level + ".txt");
    if (!file) throw std::runtime_error(std::string("no NIST problems of difficulty ") + level);
    std::string key;
    for (std::string word; file >> word;) {
      if (std::isalpha(static_cast<unsigned char>(word[0])) && key != "problem") key = word;
      else if (key == "problem") all.push_back({level, word, {}}), key = "";
      else add_numbers(word, all.back().numbers[key]);
    }
  }
  return all;
}

}  // namespace halyard
