#pragma once
/// Numbers as decimal text, the same in every locale. printf, std::to_string and std::stod follow the C locale instead,
/// which a program that embeds halyard may have set to one with decimal commas.

#include <string>

namespace halyard {

/// To so many significant digits, without zeros at the end, with an exponent where it is shorter; as printf's %g.
std::string with_digits(double value, int digits);

/// To so many digits behind the point; as printf's %f.
std::string with_decimals(double value, int decimals);

/// The double that is nearest to with_digits(); the value itself if that is beyond the largest double.
double rounded_to_digits(double value, int digits);

/// The same for with_decimals().
double rounded_to_decimals(double value, int decimals);

}  // namespace halyard
