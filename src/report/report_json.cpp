#include "report/report_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "base/error.h"
#include "report/report_fields.h"

namespace skinforge {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLineLength = 110;  // ours: as our source code

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};
template <class T, std::size_t N>
struct IsList<std::array<T, N>> : std::true_type {};
template <class T, std::size_t N>
constexpr std::size_t fixed_size(const std::array<T, N>*) {
  return N;
}
constexpr std::size_t fixed_size(const void*) {
  return 0;
}

std::string_view to_string(Severity severity) {
  return severity == Severity::Note ? "note" : "warning";
}

/// All values of an enumeration, for the schema.
template <class E>
constexpr std::size_t kEnumerators = 0;
template <>
constexpr std::size_t kEnumerators<Severity> = 2;
template <>
constexpr std::size_t kEnumerators<LedgerKind> = 6;
template <>
constexpr std::size_t kEnumerators<LedgerState> = 3;

template <class T>
Json json_of(const T& value);

struct ValueWriter {
  Json object = Json::object();

  template <class T>
  void operator()(const char* name, const T& value, const char*, const char*) {
    object[name] = json_of(value);
  }
};

template <class T>
Json json_of(const T& value) {
  if constexpr (IsOptional<T>::value) {
    return value ? json_of(*value) : Json(nullptr);
  } else if constexpr (IsList<T>::value) {
    Json list = Json::array();
    for (const auto& item : value) list.push_back(json_of(item));
    return list;
  } else if constexpr (std::is_enum_v<T>) {
    return to_string(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else {
    ValueWriter writer;
    describe(value, writer);
    return std::move(writer.object);
  }
}

template <class T>
Json schema_of();

struct SchemaWriter {
  Json properties = Json::object();
  Json required = Json::array();

  template <class T>
  void operator()(const char* name, const T&, const char* unit, const char* meaning) {
    Json property{{"description", meaning}, {"unit", unit}};
    property.update(schema_of<T>());
    properties[name] = std::move(property);
    required.push_back(name);
  }
};

template <class E>
Json enum_schema() {
  Json names = Json::array();
  for (std::size_t i = 0; i < kEnumerators<E>; ++i) names.push_back(to_string(static_cast<E>(i)));
  return {{"type", "string"}, {"enum", names}};
}

template <class T>
Json schema_of() {
  if constexpr (IsOptional<T>::value) {
    Json schema = schema_of<typename T::value_type>();
    schema["type"] = Json::array({schema["type"], "null"});
    return schema;
  } else if constexpr (IsList<T>::value) {
    Json schema{{"type", "array"}, {"items", schema_of<typename T::value_type>()}};
    if (const std::size_t n = fixed_size(static_cast<const T*>(nullptr)); n > 0)
      schema.update(Json{{"minItems", n}, {"maxItems", n}});
    return schema;
  } else if constexpr (std::is_enum_v<T>) {
    return enum_schema<T>();
  } else if constexpr (std::is_floating_point_v<T>) {
    return {{"type", "number"}};
  } else if constexpr (std::is_same_v<T, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_integral_v<T>) {
    return {{"type", "integer"}};
  } else if constexpr (std::is_same_v<T, std::string>) {
    return {{"type", "string"}};
  } else {
    SchemaWriter writer;
    describe(T{}, writer);
    return {{"type", "object"},
            {"properties", writer.properties},
            {"required", writer.required},
            {"additionalProperties", false}};
  }
}

// Appends a value in one line. False as soon as `text` has outgrown `limit`: it is then cut somewhere.
bool append_line(const Json& value, std::size_t limit, std::string& text) {
  if (value.is_primitive()) {
    text += value.dump();
    return text.size() <= limit;
  }
  text += value.is_array() ? '[' : '{';
  bool is_first = true;
  for (const auto& item : value.items()) {
    if (!is_first) text += ", ";
    is_first = false;
    if (value.is_object()) text += Json(item.key()).dump() + ": ";
    if (!append_line(item.value(), limit, text)) return false;
  }
  text += value.is_array() ? ']' : '}';
  return text.size() <= limit;
}

// One line where it fits, else one item a line.
void print(const Json& value, std::size_t indent, std::string& text) {
  const std::size_t begin = text.size();
  const bool fits = append_line(value, begin + kLineLength - std::min(indent, kLineLength), text);
  if (fits || value.is_primitive() || value.empty()) return;
  text.resize(begin);
  text += value.is_array() ? "[\n" : "{\n";
  bool is_first = true;
  for (const auto& item : value.items()) {
    if (!is_first) text += ",\n";
    is_first = false;
    text += std::string(indent + 2, ' ');
    if (value.is_object()) text += Json(item.key()).dump() + ": ";
    print(item.value(), indent + 2, text);
  }
  text.append(1, '\n').append(indent, ' ').append(1, value.is_array() ? ']' : '}');
}

std::string printed(const Json& value) try {
  std::string text;
  print(value, 0, text);
  return text + "\n";
} catch (const Json::exception& error) {
  throw Error(ExitCode::Internal, "report: " + std::string(error.what()));
}

}  // namespace

std::string to_json(const Report& report) {
  return printed(json_of(report));
}

std::string to_json(const Timings& timings) {
  return printed(json_of(timings));
}

std::string report_schema() {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "SkinForge report"},
              {"description", "What one build says about its result. Equal builds give equal reports."}};
  schema.update(schema_of<Report>());
  return printed(schema);
}

}  // namespace skinforge
