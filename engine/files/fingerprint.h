// SPDX-License-Identifier: Apache-2.0
// Hashes of contents, used as names.
#pragma once
#include <cstddef>
#include <string>

namespace vestige {

/// 32 hexadecimal digits, the same on every machine for the same bytes.
std::string fingerprint(const void* bytes, std::size_t count);
/// Fingerprint of a file's contents; "" if it cannot be read.
std::string fileFingerprint(const std::string& file);

}  // namespace vestige
