#include "tests/contract/random_message.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>

#include <cmath>
#include <string>

namespace kcs::contract {
namespace {

using namespace google::protobuf;

bool coin(std::mt19937_64& random) { return random() % 2 == 0; }

std::string text(std::mt19937_64& random) {
  std::string made;
  while (random() % 8 != 0) made += coin(random) ? "ö" : "G1 ";
  return made;
}

// Of any size, and as often whole as not.
double number(std::mt19937_64& random) {
  return std::ldexp(static_cast<double>(static_cast<std::int32_t>(random())), static_cast<int>(random() % 64) - 48);
}

// Adds an element to a repeated field, or sets one that is not.
void fill_field(Message& message, const FieldDescriptor& field, std::mt19937_64& random, int depth) {
  const Reflection& access = *message.GetReflection();
  const auto put = [&](auto add, auto set, auto value) {
    field.is_repeated() ? (access.*add)(&message, &field, value) : (access.*set)(&message, &field, value);
  };
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return put(&Reflection::AddInt32, &Reflection::SetInt32, static_cast<std::int32_t>(random()));
    case FieldDescriptor::CPPTYPE_INT64:
      return put(&Reflection::AddInt64, &Reflection::SetInt64, static_cast<std::int64_t>(random()));
    case FieldDescriptor::CPPTYPE_UINT32:
      return put(&Reflection::AddUInt32, &Reflection::SetUInt32, static_cast<std::uint32_t>(random()));
    case FieldDescriptor::CPPTYPE_UINT64:
      return put(&Reflection::AddUInt64, &Reflection::SetUInt64, static_cast<std::uint64_t>(random()));
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return put(&Reflection::AddDouble, &Reflection::SetDouble, number(random));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return put(&Reflection::AddFloat, &Reflection::SetFloat, static_cast<float>(number(random)));
    case FieldDescriptor::CPPTYPE_BOOL:
      return put(&Reflection::AddBool, &Reflection::SetBool, coin(random));
    case FieldDescriptor::CPPTYPE_ENUM:
      return put(&Reflection::AddEnumValue, &Reflection::SetEnumValue, static_cast<int>(random() % 20));
    case FieldDescriptor::CPPTYPE_STRING:
      return put(&Reflection::AddString, &Reflection::SetString, text(random));
    case FieldDescriptor::CPPTYPE_MESSAGE:
      if (depth == 0) return;
      return fill(
          *(field.is_repeated() ? access.AddMessage(&message, &field) : access.MutableMessage(&message, &field)),
          random, depth - 1);
  }
}

}  // namespace

void fill(Message& message, std::mt19937_64& random, int depth) {
  const Descriptor& type = *message.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    // A map would keep one of two elements that happen to have the same key.
    const std::uint64_t count = field.is_repeated() && !field.is_map() ? random() % 5 : random() % 2;
    for (std::uint64_t k = 0; k < count; ++k) fill_field(message, field, random, depth);
  }
}

void add_future_fields(Message& message, std::mt19937_64& random) {
  constexpr int kFirst = 1'000'000;
  const Reflection& access = *message.GetReflection();
  UnknownFieldSet& unknown = *access.MutableUnknownFields(&message);
  unknown.AddVarint(kFirst, random());
  unknown.AddFixed32(kFirst + 1, static_cast<std::uint32_t>(random()));
  unknown.AddFixed64(kFirst + 2, random());
  unknown.AddLengthDelimited(kFirst + 3, text(random));
  std::vector<const FieldDescriptor*> fields;
  access.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE || field->is_map()) continue;
    if (!field->is_repeated()) {
      add_future_fields(*access.MutableMessage(&message, field), random);
      continue;
    }
    for (int i = 0; i < access.FieldSize(message, field); ++i) {
      add_future_fields(*access.MutableRepeatedMessage(&message, field, i), random);
    }
  }
}

}  // namespace kcs::contract
