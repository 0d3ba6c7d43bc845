// encode() and decode() of all messages, made from each message's list of arrays and fields.
#pragma once

#include <exception>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/refused_field.h"
#include "messages/wire.h"

namespace tern::wire {

/// The form of a message on the wire. The source file of each message specializes it.
///
///     using Message = …;                                        the generated type
///     static constexpr Layout kLayout{…};                       its arrays
///     static void fields(auto& io, auto& m, auto& value);       its fields; io is a FieldWriter or a FieldReader
///     static void write_rest(Message&, const T&);               optional: fields with another form on the wire
///     static void read_rest(FieldReader&, const Message&, T&);  optional: such fields, and rules between fields
template <class T>
struct Form;

/// Reads and checks the fields of a decoded message.
template <class T>
T read_fields(FieldReader& read, const typename Form<T>::Message& message) {
  T value;
  Form<T>::fields(read, message, value);
  read.leave();
  if constexpr (requires { Form<T>::read_rest(read, message, value); }) Form<T>::read_rest(read, message, value);
  return value;
}

/// Checks the length first, then calls the generated decoder.
template <class T>
tl::expected<typename Form<T>::Message, Rejection> read_message(std::span<const std::uint8_t> bytes) {
  const auto end = message_bytes(bytes, Form<T>::kLayout);
  if (!end) return tl::make_unexpected(end.error());
  typename Form<T>::Message message{};
  const auto size = static_cast<int>(*end);
  if (message.decode(bytes.data(), 0, size) != size) return tl::make_unexpected(Rejection::Length);
  return message;
}

}  // namespace tern::wire

namespace tern {

template <class T>
Bytes encode(const T& value) {
  using Form = wire::Form<T>;
  wire::FieldWriter write;
  typename Form::Message message{};
  Form::fields(write, message, value);
  if constexpr (requires { Form::write_rest(message, value); }) Form::write_rest(message, value);
  return wire::encode(std::move(message), Form::kLayout);
}

template <class T>
tl::expected<T, Rejection> decode(std::span<const std::uint8_t> bytes) {
  try {
    const auto message = wire::read_message<T>(bytes);
    if (!message) return tl::make_unexpected(message.error());
    wire::FieldReader read;
    T value = wire::read_fields<T>(read, *message);
    return read.accept(std::move(value));
  } catch (const std::exception&) {  // out of memory, or a check that a value's own class repeats
    return tl::make_unexpected(Rejection::Length);
  }
}

/// Returns a reader that has read the message, or has read nothing of one whose form is refused.
template <class T>
wire::FieldReader reader_of(std::span<const std::uint8_t> bytes) {
  wire::FieldReader read;
  try {
    if (const auto message = wire::read_message<T>(bytes)) wire::read_fields<T>(read, *message);
  } catch (const std::exception&) {  // the same
    return {};
  }
  return read;
}

template <class T>
std::string refused_field(std::span<const std::uint8_t> bytes) {
  return reader_of<T>(bytes).refused_field();
}

template <class T>
std::int32_t left_out_elements(std::span<const std::uint8_t> bytes) {
  const wire::FieldReader read = reader_of<T>(bytes);
  return read.ok() ? read.left_out() : 0;
}

}  // namespace tern
