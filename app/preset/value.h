// SPDX-License-Identifier: Apache-2.0
// A value of a preset as what it is at run time: its kind, its items, its fields. Reading, writing, the schema and the
// editor walk over values, so that they are compiled once and not for every struct.
#pragma once
#include "preset/field.h"
#include "preset/settings.h"

#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>

namespace nephroid::preset {

class Fields;

/// numbers: a list of numbers; texts: of texts; table: rows of two numbers; list and map: of objects. optional holds
/// one item or none.
enum class Kind { boolean, integer, number, text, word, numbers, texts, table, object, list, map, optional };

/// One word of an enumeration.
struct Word {
  std::string_view name, sentence;
};

/// What a bare JSON value in place of a struct may be.
enum class BareValue { number, text };

/// `"dispersion": 1.5` stands for `{"type": "constant", "n": 1.5}`: a bare value is the field `field` of the type
/// `type`.
struct Shorthand {
  BareValue bare;
  std::string_view type, field;
};

/// A type that values have. `void*` is a value of it.
struct ValueType {
  Kind kind = Kind::object;
  const ValueType* item = nullptr; ///< the type of what a list, a map or an optional value holds
  std::size_t size = 0;            ///< how many numbers there are; 0: any number
  std::vector<Word> words = {};    ///< all that a word may be
  std::string_view name = {}, sentence = {};
  std::vector<Shorthand> shorthands = {}; ///< an object's

  std::size_t (*word)(const void*) = nullptr; ///< which one of words it is
  void (*choose)(void*, std::size_t) = nullptr;
  std::size_t (*count)(const void*) = nullptr; ///< the number of items
  void (*resize)(void*, std::size_t) = nullptr;
  void* (*at)(void*, std::size_t) = nullptr;
  const std::string& (*key)(const void* map, std::size_t) = nullptr;
  void* (*add)(void* map, const std::string& key) = nullptr;
  std::shared_ptr<void> (*make)() = nullptr; ///< an object by default
  void (*describe)(Fields&, void*) = nullptr;
};

struct Member;

/// Where a value is, and of what type: like a reference, it is copied without what it refers to.
class Value {
public:
  template <class T>
  requires(!std::is_same_v<T, Value>) explicit Value(T& value);
  Value(void* at, const ValueType& type) : at_(at), type_(&type) {}

  const ValueType& type() const { return *type_; }
  Kind kind() const { return type_->kind; }
  /// False for settings of another engine than the preset's.
  bool exists() const { return at_ != nullptr; }
  /// T: just what the value is.
  template <class T>
  T& as() const {
    return *static_cast<T*>(at_);
  }
  template <class T>
  bool is() const;
  const Word& word() const { return type_->words[type_->word(at_)]; }
  void choose(std::size_t index) const { type_->choose(at_, index); }
  std::size_t count() const { return type_->count(at_); }
  /// The items there are then are by default.
  void resize(std::size_t count) const { type_->resize(at_, count); }
  Value operator[](std::size_t i) const { return {type_->at(at_, i), *type_->item}; }
  const std::string& key(std::size_t i) const { return type_->key(at_, i); }
  /// An item by default of a map.
  Value add(const std::string& key) const { return {type_->add(at_, key), *type_->item}; }
  /// The fields that an object has by its type, in the order of files.
  std::vector<Member> members() const;

private:
  void* at_;
  const ValueType* type_;
};

/// type: the word that says which further fields its object has. engine: the word that names the preset's engine.
/// section: the settings of an engine; those of the preset's engine exist. recipe: optional settings of an engine, of
/// which the preset's may be there.
enum class Role { plain, type, engine, section, recipe };

/// A field of an object.
struct Member {
  Field field;
  Value value;
  Role role = Role::plain;

  bool chooses() const { return role == Role::type || role == Role::engine; }
};

template <class T>
const ValueType& type_of();

/// What describe() of a struct says: describe.h.
class Fields {
public:
  /// What the struct is called, in one word and in a sentence.
  void about(std::string_view name, std::string_view sentence) { name_ = name, sentence_ = sentence; }
  template <Enumeration E>
  void shorthand(BareValue bare, E type, std::string_view field) {
    shorthands_.push_back({bare, preset::word(type), field});
  }
  /// more: all else there is to say about the field.
  template <class T>
  void field(std::string_view name, std::string_view sentence, T& value, const Field& more = {}) {
    add(name, sentence, Value(value), Role::plain, more);
  }
  template <Enumeration E>
  void type(std::string_view name, std::string_view sentence, E& value) {
    add(name, sentence, Value(value), Role::type, {});
  }
  void engine(std::string_view name, std::string_view sentence, Settings& settings) {
    add(name, sentence, Value(settings), Role::engine, {});
  }
  void settings(Settings& settings);
  void settings(std::optional<Settings>& settings);

private:
  friend class Value;
  friend ValueType described(ValueType type);
  void add(std::string_view name, std::string_view sentence, const Value& value, Role role, Field more);

  std::string_view name_, sentence_;
  std::vector<Shorthand> shorthands_;
  std::vector<Member> members_;
};

/// The type of a struct with what its description says about it.
ValueType described(ValueType type);
ValueType make_type(Settings*);
ValueType make_type(std::string*);

inline ValueType make_type(bool*) { return {.kind = Kind::boolean}; }
inline ValueType make_type(double*) { return {.kind = Kind::number}; }
inline ValueType make_type(int*) { return {.kind = Kind::integer}; }
inline ValueType make_type(std::uint64_t*) { return {.kind = Kind::integer}; }

template <Enumeration E>
ValueType make_type(E*) {
  ValueType type{.kind = Kind::word};
  for (const Choice<E>& choice : choices<E>) type.words.push_back({choice.name, choice.sentence});
  type.word = [](const void* value) {
    std::size_t i = 0;
    while (choices<E>[i].value != *static_cast<const E*>(value)) ++i;
    return i;
  };
  type.choose = [](void* value, std::size_t i) { *static_cast<E*>(value) = choices<E>[i].value; };
  return type;
}

template <class T, std::size_t N>
ValueType make_type(std::array<T, N>*) {
  using Array = std::array<T, N>;
  ValueType type{.kind = Kind::numbers, .item = &type_of<T>(), .size = N};
  type.count = [](const void*) { return N; };
  type.resize = [](void* array, std::size_t) { *static_cast<Array*>(array) = {}; };
  type.at = [](void* array, std::size_t i) -> void* { return &(*static_cast<Array*>(array))[i]; };
  return type;
}

constexpr Kind kind_of_list(Kind item) {
  return item == Kind::number    ? Kind::numbers
         : item == Kind::text    ? Kind::texts
         : item == Kind::numbers ? Kind::table
                                 : Kind::list;
}

template <class T>
ValueType make_type(std::vector<T>*) {
  using List = std::vector<T>;
  ValueType type{.kind = kind_of_list(type_of<T>().kind), .item = &type_of<T>()};
  type.count = [](const void* list) { return static_cast<const List*>(list)->size(); };
  type.resize = [](void* list, std::size_t count) { static_cast<List*>(list)->assign(count, T{}); };
  type.at = [](void* list, std::size_t i) -> void* { return &(*static_cast<List*>(list))[i]; };
  return type;
}

template <class T>
ValueType make_type(std::map<std::string, T>*) {
  using Map = std::map<std::string, T>;
  ValueType type{.kind = Kind::map, .item = &type_of<T>()};
  type.count = [](const void* map) { return static_cast<const Map*>(map)->size(); };
  type.resize = [](void* map, std::size_t) { static_cast<Map*>(map)->clear(); };
  type.at = [](void* map, std::size_t i) -> void* {
    return &std::next(static_cast<Map*>(map)->begin(), static_cast<int>(i))->second;
  };
  type.key = [](const void* map, std::size_t i) -> const std::string& {
    return std::next(static_cast<const Map*>(map)->begin(), static_cast<int>(i))->first;
  };
  type.add = [](void* map, const std::string& key) -> void* { return &((*static_cast<Map*>(map))[key] = T{}); };
  return type;
}

template <class T>
ValueType make_type(std::optional<T>*) {
  using Optional = std::optional<T>;
  ValueType type{.kind = Kind::optional, .item = &type_of<T>()};
  type.count = [](const void* value) {
    return static_cast<const Optional*>(value)->has_value() ? std::size_t{1} : std::size_t{0};
  };
  type.resize = [](void* value, std::size_t count) {
    static_cast<Optional*>(value)->reset();
    if (count > 0) static_cast<Optional*>(value)->emplace();
  };
  type.at = [](void* value, std::size_t) -> void* { return &**static_cast<Optional*>(value); };
  return type;
}

template <class S>
requires std::is_class_v<S> ValueType make_type(S*) {
  return described({.make = []() -> std::shared_ptr<void> { return std::make_shared<S>(); },
                    .describe = [](Fields& fields, void* object) { describe(fields, *static_cast<S*>(object)); }});
}

template <class T>
const ValueType& type_of() {
  static const ValueType type = make_type(static_cast<T*>(nullptr));
  return type;
}

template <class T>
requires(!std::is_same_v<T, Value>) Value::Value(T& value) : at_(&value), type_(&type_of<T>()) {}

template <class T>
bool Value::is() const {
  return type_ == &type_of<T>();
}

/// For what only reads: a value of what must not change.
template <class T>
Value value_of(const T& value) {
  return Value(const_cast<T&>(value));
}

} // namespace nephroid::preset
