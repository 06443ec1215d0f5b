#!/usr/bin/python3
"""Prints the contract as a page: every service, message and enum with the comments of the .proto files.

usage: reference.py FILE.proto...   (in the folder that their imports start from)
"""

import subprocess
import sys
import tempfile

from google.protobuf import descriptor_pb2

Field = descriptor_pb2.FieldDescriptorProto
HEAD = "<!-- Made of the .proto files by ./run reference: change those. -->\n# The contract of kcs, version 1\n"


def files_of(names):
    """The descriptors of the named files, with their comments."""
    with tempfile.NamedTemporaryFile() as out:
        subprocess.run(
            ["protoc", "-I.", "--include_source_info", f"--descriptor_set_out={out.name}", *names], check=True)
        return descriptor_pb2.FileDescriptorSet.FromString(out.read()).file


class Page:
    """What one file defines, as Markdown."""

    def __init__(self, file):
        self.file = file
        self.comments = {tuple(place.path): place for place in file.source_code_info.location}

    def comment(self, *path):
        """Paragraphs of what stands before a definition, or behind it on its line."""
        place = self.comments.get(path)
        if place is None:
            return []
        text = place.leading_comments or place.trailing_comments
        return [" ".join(line.strip() for line in part.splitlines()) for part in text.split("\n\n")] if text else []

    def head(self):
        """The comment at the top of the file."""
        place = self.comments[(12,)]  # the line syntax = …
        return "\n".join(line.strip() for line in place.leading_comments.splitlines())

    def render(self):
        yield f"\n## {self.file.name}\n"
        yield self.head() + "\n"
        for i, service in enumerate(self.file.service):
            yield from self.service(service, (6, i))
        for i, message in enumerate(self.file.message_type):
            yield from self.message(message, (4, i), "")
        for i, enum in enumerate(self.file.enum_type):
            yield from self.enum(enum, (5, i))

    def service(self, service, path):
        yield f"### service {service.name}\n"
        yield from (paragraph + "\n" for paragraph in self.comment(*path))
        for i, method in enumerate(service.method):
            takes = ("stream " if method.client_streaming else "") + linked(method.input_type)
            gives = ("stream " if method.server_streaming else "") + linked(method.output_type)
            yield f"**{method.name}** ({takes}) → {gives}\n"
            yield from (paragraph + "\n" for paragraph in self.comment(*path, 2, i))

    def message(self, message, path, outer):
        name = outer + message.name
        yield f"### {name}\n"
        yield from (paragraph + "\n" for paragraph in self.comment(*path))
        if message.field:
            yield "| Field | Type | Meaning |\n|-|-|-|"
            for i, field in enumerate(message.field):
                yield row(f"`{field.name}` = {field.number}", type_of(field, message), self.comment(*path, 2, i))
            yield ""
        for i, nested in enumerate(message.nested_type):
            yield from self.message(nested, (*path, 3, i), name + ".")

    def enum(self, enum, path):
        yield f"### {enum.name}\n"
        yield from (paragraph + "\n" for paragraph in self.comment(*path))
        yield "| Value | Number | Meaning |\n|-|-|-|"
        for i, value in enumerate(enum.value):
            yield row(f"`{value.name}`", str(value.number), self.comment(*path, 2, i))
        yield ""


def row(*cells):
    texts = (cell if isinstance(cell, str) else "<br>".join(cell) for cell in cells)
    return "| " + " | ".join(text.replace("|", "\\|") for text in texts) + " |"


def linked(type_name):
    """.kcs.v1.Plan as a link to its heading; types of others as they are."""
    name = type_name.lstrip(".")
    if not name.startswith("kcs.v1."):
        return f"`{name}`"
    name = name.removeprefix("kcs.v1.")
    return f"[{name}](#{name.lower().replace('.', '')})"


def type_of(field, message):
    kind = linked(field.type_name) if field.type_name else Field.Type.Name(field.type).removeprefix("TYPE_").lower()
    if field.label == Field.LABEL_REPEATED:
        return "repeated " + kind
    if field.proto3_optional:
        return "optional " + kind
    if field.HasField("oneof_index"):
        return f"{kind}, one of `{message.oneof_decl[field.oneof_index].name}`"
    return kind


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print(HEAD, end="")
    for file in files_of(sys.argv[1:]):
        for part in Page(file).render():
            print(part)


if __name__ == "__main__":
    main()
