#pragma once

#include <string>
#include <string_view>

namespace swept {

/// The letters of a UTF-8 text, each as one or more that the stroke font has, where there are some that are read as it
/// is: Latin letters without their accents ("ü" as u, "ß" as ss), quotation marks, dashes. Others stay what they are,
/// and bytes that are not UTF-8 become letters that no font has.
std::u32string plainLetters(std::string_view text);

}  // namespace swept
