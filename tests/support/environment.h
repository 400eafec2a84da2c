#pragma once
/// A variable of the environment, set while a test runs.

#include <cstdlib>
#include <string>

namespace halyard {

class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Environment() { unsetenv(name_); }

 private:
  const char* name_;
};

}  // namespace halyard
