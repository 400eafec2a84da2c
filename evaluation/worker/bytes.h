#pragma once
/// Serialises numbers and texts for another process on the same machine.

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/log.h"

namespace halyard {

class ByteWriter {
 public:
  void number(double x) { raw(&x, sizeof x); }
  void count(std::size_t n) { raw(&n, sizeof n); }
  void flag(bool is) { raw(&is, sizeof is); }
  void text(std::string_view all) {
    count(all.size());
    raw(all.data(), all.size());
  }
  void texts(const std::vector<std::string>& all) {
    count(all.size());
    for (const std::string& one : all) text(one);
  }
  void numbers(const std::vector<double>& all) {
    count(all.size());
    raw(all.data(), all.size() * sizeof(double));
  }
  void signals(const Signals& all) {
    count(all.size());
    for (const auto& column : all) numbers(column);
  }
  std::string take() { return std::move(bytes_); }

 private:
  void raw(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }

  std::string bytes_;
};

/// Reads the bytes of a ByteWriter, in the same order. Every function throws std::runtime_error if the bytes end early.
/// Counts are checked against the bytes that are left.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  double number() { return raw<double>(); }
  std::size_t count() { return raw<std::size_t>(); }
  bool flag() { return raw<char>() != 0; }
  std::string text() { return std::string(take(count())); }
  std::vector<std::string> texts() {
    std::vector<std::string> all(checked_count(sizeof(std::size_t)));
    for (std::string& one : all) one = text();
    return all;
  }
  std::vector<double> numbers() {
    std::vector<double> all(checked_count(sizeof(double)));
    const std::string_view bytes = take(all.size() * sizeof(double));
    if (!all.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
    return all;
  }
  Signals signals() {
    Signals all(checked_count(sizeof(std::size_t)));
    for (auto& column : all) column = numbers();
    return all;
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > left_.size()) throw std::runtime_error("its process ended early");
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }
  template <class T>
  T raw() {
    T x;
    std::memcpy(&x, take(sizeof x).data(), sizeof x);
    return x;
  }
  /// Reads a count of items of at least `size` bytes each.
  std::size_t checked_count(std::size_t size) {
    const std::size_t n = count();
    if (n > left_.size() / size) throw std::runtime_error("its process ended early");
    return n;
  }

  std::string_view left_;
};

}  // namespace halyard
