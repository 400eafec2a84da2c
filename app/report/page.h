#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/report/chart.h"

namespace halyard::report {

/// One table cell; numbers are already formatted.
struct Cell {
  Cell(std::string content, bool is_best = false) : text(std::move(content)), best(is_best) {}
  Cell(const char* content, bool is_best = false) : text(content), best(is_best) {}

  /// A relative address, such as "experiments/report.html".
  static Cell link(std::string content, std::string address) {
    Cell cell(std::move(content));
    cell.href = std::move(address);
    return cell;
  }

  /// An error before and after a change: highlighted if it has become less by a tenth, marked if it has become more.
  static Cell of_change(std::string content, double before, double after) {
    Cell cell(std::move(content), after < 0.9 * before);
    cell.worse = after > 1.1 * before;
    return cell;
  }

  std::string text;
  bool best;           ///< highlighted
  bool worse = false;  ///< marked as a change for the worse
  std::string href;    ///< address of the link; empty: no link
};

enum class Align { left, right };

struct Table {
  std::string caption = {};
  std::vector<std::string> header = {};
  std::vector<std::vector<Cell>> rows = {};  ///< each has as many cells as the header
  std::vector<Align> align = {};             ///< one per column; empty: first column left, others right
};

enum class VerdictKind { good, warning, bad, neutral };

/// A report in one self-contained HTML file: style, Chart.js and data are inside. Parts appear in the order
/// of the calls. All text is UTF-8 and escaped. Equal calls give equal bytes.
class Page {
 public:
  Page(std::string title, std::string subtitle);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  /// items: a list below the headline.
  void verdict(VerdictKind kind, const std::string& headline, const std::vector<std::string>& items = {});
  /// A paragraph with a link to another file; the address is relative to this page.
  void link(const std::string& text, const std::string& address);

  /// Throws std::invalid_argument, naming table and row, if a row or the alignment is not as long as the header.
  void table(const Table& table);

  /// Throws as to_json() does.
  void chart(const Chart& chart);

  /// Charts side by side, wrapping where the window is narrow. Throws as to_json() does.
  void figure_row(const std::vector<Chart>& charts);

  std::string html() const;

 private:
  std::string title_;
  std::string subtitle_;
  std::string body_;
};

}  // namespace halyard::report
