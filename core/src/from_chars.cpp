#include <octetra/core/from_chars.hpp>

#include <locale.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

namespace octetra {
namespace {

/// strtod() accepts more than std::from_chars(): blanks and + before the number, and hexadecimal
/// digits after 0x.
bool may_belong_to_number(char c) {
    return c != 'x' && c != 'X' &&
           (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '+' || c == '-' ||
            c == '(' || c == ')' || c == '_');
}

}  // namespace

std::from_chars_result from_chars_by_strtod(const char* first, const char* last, double& number) {
    static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
    if (first == last || *first == '+') return {first, std::errc::invalid_argument};
    const std::string text(first, std::find_if_not(first, last, may_belong_to_number));
    char* end = nullptr;
    errno = 0;
    const double value = strtod_l(text.c_str(), &end, c_locale);
    if (end == text.c_str()) return {first, std::errc::invalid_argument};
    const char* const stop = first + (end - text.c_str());
    // A subnormal number may set ERANGE too.
    if (errno == ERANGE && (value == 0 || std::isinf(value))) {
        return {stop, std::errc::result_out_of_range};
    }
    number = value;
    return {stop, std::errc{}};
}

}  // namespace octetra
