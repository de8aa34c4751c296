// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Writes JSON (RFC 8259) as one line of text. Commas are set by the writer; the caller opens and closes:
//
//     JsonWriter json;
//     json.beginObject();
//     json.key("frames").value(600);
//     json.endObject();
//     json.take();                       {"frames":600}

namespace carom {

class JsonWriter {
  public:
    JsonWriter& beginObject() { return open('{'); }
    JsonWriter& endObject() { return close('}'); }
    JsonWriter& beginArray() { return open('['); }
    JsonWriter& endArray() { return close(']'); }
    JsonWriter& key(std::string_view name);

    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    /// Shortest round trip; null where it is not finite, which JSON cannot say.
    JsonWriter& value(double number);
    JsonWriter& value(std::int64_t number);
    JsonWriter& value(std::uint64_t number);
    JsonWriter& value(int number) { return value(static_cast<std::int64_t>(number)); }
    JsonWriter& value(bool boolean);
    JsonWriter& null();

    std::string take() { return std::move(m_text); }

  private:
    JsonWriter& open(char bracket);
    JsonWriter& close(char bracket);
    JsonWriter& bare(std::string_view text);
    void separate();
    void quote(std::string_view text);

    std::string m_text;
    bool m_first = true; ///< nothing stands in front of the next item
};

} // namespace carom
