#include "tests/contract/breaks.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

namespace kcs::contract {
namespace {

using namespace google::protobuf;

constexpr std::string_view kStays =
    "what was released stays: bring it back, and mark it deprecated if it is no more use";

// All of a field that both sides must see alike.
std::array<std::pair<std::string_view, std::string>, 6> properties(const FieldDescriptor& field) {
  std::string type = field.type_name();
  if (field.message_type()) type = field.message_type()->full_name();
  if (field.enum_type()) type = field.enum_type()->full_name();
  const char* const one = field.has_presence() ? "one that can be absent" : "one";
  const OneofDescriptor* const oneof = field.real_containing_oneof();
  return {{{"name", field.name()},
           {"JSON name", field.json_name()},
           {"type", type},
           {"count", field.is_repeated() ? "repeated" : one},
           {"packing", field.is_packed() ? "packed" : "not packed"},
           {"oneof", oneof ? oneof->name() : "none"}}};
}

class Comparison {
 public:
  explicit Comparison(const DescriptorPool& present) : present_(present) {}

  void compare(const FileDescriptor& released);
  std::vector<std::string> found() && { return std::move(found_); }

 private:
  void compare(const Descriptor& released);
  void compare(const FieldDescriptor& released, const Descriptor& present);
  void compare(const EnumDescriptor& released);
  void compare(const EnumValueDescriptor& released, const EnumDescriptor& present);
  void compare(const ServiceDescriptor& released);
  void compare(const MethodDescriptor& released, const MethodDescriptor& present);
  void add(const std::string& name, std::string_view how, std::string_view remedy) {
    found_.push_back(fmt::format("{}: {}; {}", name, how, remedy));
  }

  const DescriptorPool& present_;
  std::vector<std::string> found_;
};

void Comparison::compare(const FileDescriptor& released) {
  for (int i = 0; i < released.message_type_count(); ++i) compare(*released.message_type(i));
  for (int i = 0; i < released.enum_type_count(); ++i) compare(*released.enum_type(i));
  for (int i = 0; i < released.service_count(); ++i) compare(*released.service(i));
}

void Comparison::compare(const Descriptor& released) {
  const Descriptor* const present = present_.FindMessageTypeByName(released.full_name());
  if (present == nullptr) return add(released.full_name(), "the message is gone", kStays);
  for (int i = 0; i < released.field_count(); ++i) compare(*released.field(i), *present);
  for (int i = 0; i < present->field_count(); ++i) {
    const FieldDescriptor& field = *present->field(i);
    if (released.IsReservedNumber(field.number())) {
      add(field.full_name(), fmt::format("the number {} was reserved", field.number()), "use the next free number");
    }
  }
  for (int i = 0; i < released.nested_type_count(); ++i) compare(*released.nested_type(i));
  for (int i = 0; i < released.enum_type_count(); ++i) compare(*released.enum_type(i));
}

void Comparison::compare(const FieldDescriptor& released, const Descriptor& present) {
  const FieldDescriptor* const field = present.FindFieldByNumber(released.number());
  if (field == nullptr) {
    if (present.IsReservedNumber(released.number()) && present.IsReservedName(released.name())) return;
    return add(released.full_name(), fmt::format("the field of number {} is gone", released.number()),
               fmt::format("reserve both: reserved {}; reserved \"{}\";", released.number(), released.name()));
  }
  const auto was = properties(released), is = properties(*field);
  for (std::size_t i = 0; i < was.size(); ++i) {
    if (was[i].second == is[i].second) continue;
    return add(released.full_name(), fmt::format("its {} was {} and is {}", was[i].first, was[i].second, is[i].second),
               fmt::format("leave the field of number {} as it was, and add another one", released.number()));
  }
}

void Comparison::compare(const EnumDescriptor& released) {
  const EnumDescriptor* const present = present_.FindEnumTypeByName(released.full_name());
  if (present == nullptr) return add(released.full_name(), "the enum is gone", kStays);
  for (int i = 0; i < released.value_count(); ++i) compare(*released.value(i), *present);
  for (int i = 0; i < present->value_count(); ++i) {
    const EnumValueDescriptor& value = *present->value(i);
    if (released.IsReservedNumber(value.number())) {
      add(value.full_name(), fmt::format("the number {} was reserved", value.number()), "use the next free number");
    }
  }
}

void Comparison::compare(const EnumValueDescriptor& released, const EnumDescriptor& present) {
  const EnumValueDescriptor* const value = present.FindValueByName(released.name());
  if (value == nullptr) {
    if (present.IsReservedNumber(released.number()) && present.IsReservedName(released.name())) return;
    return add(released.full_name(), fmt::format("the value {} is gone", released.number()),
               fmt::format("reserve both: reserved {}; reserved \"{}\";", released.number(), released.name()));
  }
  if (value->number() == released.number()) return;
  add(released.full_name(), fmt::format("its number was {} and is {}", released.number(), value->number()),
      "give it its number again");
}

void Comparison::compare(const ServiceDescriptor& released) {
  const ServiceDescriptor* const present = present_.FindServiceByName(released.full_name());
  if (present == nullptr) return add(released.full_name(), "the service is gone", kStays);
  for (int i = 0; i < released.method_count(); ++i) {
    const MethodDescriptor& method = *released.method(i);
    const MethodDescriptor* const same = present->FindMethodByName(method.name());
    same ? compare(method, *same) : add(method.full_name(), "the method is gone", kStays);
  }
}

void Comparison::compare(const MethodDescriptor& released, const MethodDescriptor& present) {
  const auto signature = [](const MethodDescriptor& method) {
    return fmt::format("({}{}) returns ({}{})", method.client_streaming() ? "stream " : "",
                       method.input_type()->full_name(), method.server_streaming() ? "stream " : "",
                       method.output_type()->full_name());
  };
  if (signature(released) == signature(present)) return;
  add(released.full_name(), fmt::format("it was {} and is {}", signature(released), signature(present)),
      "leave it as it was, and add another method");
}

}  // namespace

std::vector<std::string> breaks(const FileDescriptor& released, const DescriptorPool& present) {
  Comparison comparison(present);
  comparison.compare(released);
  return std::move(comparison).found();
}

}  // namespace kcs::contract
