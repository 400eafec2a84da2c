#include "app/report/page.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/report/assets.h"
#include "app/report/escaped.h"

namespace halyard::report {
namespace {

std::string element(const std::string& name, const std::string& text) {
  return "<" + name + ">" + escaped(text) + "</" + name + ">\n";
}

std::string anchor(const std::string& text, const std::string& address) {
  return "<a href=\"" + escaped(address) + "\">" + escaped(text) + "</a>";
}

/// Says so where a chart shows fewer points than there are samples.
std::string decimation_note(const Chart& chart) {
  const bool line = chart.kind == ChartKind::line;
  if (!line && chart.kind != ChartKind::scatter) return "";
  std::size_t samples = 0;
  for (const Series& series : chart.series) samples = std::max(samples, series.y.size());
  if (samples <= (line ? kDrawnPoints : 2 * kDrawnPoints)) return "";
  return "<p class=\"note\">Drawn from " + std::to_string(samples) +
         " points, thinned; peaks and outliers are kept.</p>\n";
}

std::string figure(const Chart& chart) {
  return "<figure class=\"chart\">\n<figcaption>" + escaped(chart.title) +
         "</figcaption>\n<div style=\"height:" + std::to_string(chart.height_px) +
         "px\"><canvas role=\"img\" aria-label=\"" + escaped(chart.title) + "\"></canvas></div>\n" +
         decimation_note(chart) + "<script type=\"application/json\">" + to_json(chart) + "</script>\n</figure>\n";
}

const char* class_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::good: return "good";
    case VerdictKind::warning: return "warning";
    case VerdictKind::bad: return "bad";
    case VerdictKind::neutral: return "neutral";
  }
  throw std::invalid_argument("unknown kind of verdict");
}

}  // namespace

Page::Page(std::string title, std::string subtitle) : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

void Page::heading(const std::string& text) { body_ += element("h2", text); }

void Page::paragraph(const std::string& text) { body_ += element("p", text); }

void Page::verdict(VerdictKind kind, const std::string& headline, const std::vector<std::string>& items) {
  std::string list;
  for (const std::string& item : items) list += element("li", item);
  body_ += std::string("<div class=\"verdict ") + class_of(kind) + "\">" + element("p", headline);
  if (!items.empty()) body_ += "<ul>" + list + "</ul>";
  body_ += "</div>\n";
}

void Page::link(const std::string& text, const std::string& address) {
  body_ += "<p>" + anchor(text, address) + "</p>\n";
}

void Page::table(const Table& table) {
  const std::size_t columns = table.header.size();
  const auto check = [&](std::size_t length, const std::string& what) {
    if (length == columns) return;
    throw std::invalid_argument("table \"" + table.caption + "\": " + what + " has " + std::to_string(length) +
                                " columns, expected " + std::to_string(columns) + " as in the header");
  };
  if (!table.align.empty()) check(table.align.size(), "the alignment");

  const auto cell = [&](const char* tag, std::size_t column, const Cell& content) {
    const bool right = table.align.empty() ? column > 0 : table.align[column] == Align::right;
    std::string classes = right ? "right" : "left";
    if (content.best) classes += " best";
    if (content.worse) classes += " worse";
    return std::string("<") + tag + " class=\"" + classes + "\">" +
           (content.href.empty() ? escaped(content.text) : anchor(content.text, content.href)) + "</" + tag + ">";
  };

  std::string html = "<div class=\"table\"><table>\n";
  if (!table.caption.empty()) html += "<caption><span>" + escaped(table.caption) + "</span></caption>\n";
  html += "<thead><tr>";
  for (std::size_t i = 0; i < columns; ++i) html += cell("th", i, table.header[i]);
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    check(table.rows[row].size(), "row " + std::to_string(row + 1));
    html += "<tr>";
    for (std::size_t i = 0; i < columns; ++i) html += cell("td", i, table.rows[row][i]);
    html += "</tr>\n";
  }
  body_ += html + "</tbody>\n</table></div>\n";
}

void Page::chart(const Chart& chart) { body_ += figure(chart); }

void Page::figure_row(const std::vector<Chart>& charts) {
  std::string html = "<div class=\"row\">\n";
  for (const Chart& chart : charts) html += figure(chart);
  body_ += html + "</div>\n";
}

std::string Page::html() const {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      // The browser itself then refuses whatever is not in this file.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "script-src 'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n";
  html += element("title", title_);
  html.append("<style>\n").append(assets::page_css).append("</style>\n</head>\n<body>\n<main>\n<header>\n");
  html += element("h1", title_);
  if (!subtitle_.empty()) html += element("p", subtitle_);
  html += "</header>\n<noscript><p class=\"verdict warning\">The charts need JavaScript.</p></noscript>\n";
  html += body_;
  html.append("</main>\n<script>\n").append(assets::chart_js).append("</script>\n<script>\n");
  html.append(assets::page_js).append("</script>\n</body>\n</html>\n");
  return html;
}

}  // namespace halyard::report
