#include "preprocess/read/gltf/uri.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace farcell {
namespace {

constexpr std::string_view kDataScheme = "data:";
constexpr std::string_view kBase64 = ";base64";
constexpr uint8_t kNoDigit = 255;

std::array<uint8_t, 256> base64Digits() {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<uint8_t, 256> digits;
  digits.fill(kNoDigit);
  for (size_t i = 0; i < kAlphabet.size(); ++i) digits[static_cast<uint8_t>(kAlphabet[i])] = static_cast<uint8_t>(i);
  return digits;
}

Result<std::vector<std::byte>> decodeBase64(const GltfPlace& place, std::string_view text) {
  static const std::array<uint8_t, 256> kDigits = base64Digits();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);  // padding says nothing new
  if (text.size() % 4 == 1) return place.bad("base64 text", fmt::format("{} digits", text.size()));
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  uint32_t bitCount = 0;
  for (const char c : text) {
    const uint8_t digit = kDigits[static_cast<uint8_t>(c)];
    if (digit == kNoDigit) return place.bad("base64 text", inQuotes(std::string_view(&c, 1)));
    bits = bits << 6 | digit;
    bitCount += 6;
    if (bitCount < 8) continue;
    bitCount -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> bitCount & 0xff));
  }
  return bytes;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int lower = std::tolower(static_cast<unsigned char>(c));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

Result<std::string> decodePercent(const GltfPlace& place, std::string_view uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hexDigit(uri[i + 2]) : -1;
    if (high < 0 || low < 0) return place.bad("two hexadecimal digits after '%'", inQuotes(uri.substr(i, 3)));
    text += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return text;
}

}  // namespace

bool isDataUri(std::string_view uri) { return uri.starts_with(kDataScheme); }

Result<std::vector<std::byte>> decodeDataUri(const GltfPlace& place, std::string_view uri, uint64_t maxBytes) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(kBase64))
    return place.bad("a data URI with ';base64,'", inQuotes(uri));
  const std::string_view text = uri.substr(comma + 1);
  if (text.size() / 4 * 3 > maxBytes)
    return place.failed(ErrorKind::exhausted, fmt::format("at most {} bytes in data URIs", maxBytes),
                        fmt::format("{} base64 digits", text.size()));
  return decodeBase64(place, text);
}

Result<std::filesystem::path> pathFromUri(const GltfPlace& place, std::string_view uri) {
  if (uri.substr(0, uri.find('/')).find(':') != std::string_view::npos)
    return place.failed(ErrorKind::unsupported, "a file beside this one", inQuotes(uri));
  FARCELL_ASSIGN(const std::string text, decodePercent(place, uri));
  const std::filesystem::path path(text);
  const bool stays = !text.empty() && text.find('\0') == std::string::npos && path.is_relative() &&
                     std::find(path.begin(), path.end(), "..") == path.end();
  if (!stays) return place.bad("a path below the directory of this file", inQuotes(uri));
  return path;
}

}  // namespace farcell
