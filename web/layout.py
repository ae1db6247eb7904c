#!/usr/bin/env python3
"""Writes what JavaScript must know of the C interface, as its header says, for the 32-bit pointers of WebAssembly.

usage: layout.py HEADER DIRECTORY
writes to DIRECTORY:
  calligraphy_layout.js    structs, constants and functions, without the prefix calligraphy_
  calligraphy_layout.d.ts  their types, in TypeScript
  layout_check.cpp         fails to compile where the compiler lays a struct out otherwise
"""
import collections
import json
import pathlib
import re
import sys

# Types of members: their names in JavaScript, as in getInt32 and Int32Array, and sizes, which are also alignments.
MEMBERS = {
    "int32_t": ("Int32", 4), "uint32_t": ("Uint32", 4), "uint64_t": ("BigUint64", 8), "double": ("Float64", 8),
    "char": ("char", 1),
}
POINTER = ("Uint32", 4)  # an address
# Types of a last parameter to which a function writes a single value, which JavaScript returns.
RESULTS = {
    r"calligraphy_\w+\*\*": "handle", r"u?int32_t\*": "number", r"size_t\*": "number", r"const char\*\*": "text",
}
# Types of the other parameters, and what JavaScript passes for them: an array of a type, to be read or written.
PARAMETERS = {
    "double": "Float64", "int32_t": "Int32", "uint32_t": "Uint32", "size_t": "Uint32", "void*": "handle",
    "const char*": "text", "const double*": "read Float64", "double*": "write Float64",
    "const uint32_t*": "read Uint32", "uint32_t*": "write Uint32", "int32_t*": "write Int32",
    "const void*": "read Uint8", "char*": "write Uint8",
}
# Types of TypeScript that are the same for every header.
TYPES = """\
/** An object of the library, until it is freed. */
export type Handle = number;
type Members<Kind> = Exclude<keyof Kind, "address" | "values">;
/** A copy of the members of a struct. */
export type Values<Kind> = { -readonly [Member in Members<Kind>]: Kind[Member] };
/** What a struct can be made from: those of its members that are not zero. */
export type Initial<Kind> = {
  readonly [Member in Members<Kind>]?: Kind[Member] extends number ? number | boolean
    : Kind[Member] extends string ? string : ArrayLike<number | boolean>;
};
/** Of each member: its type, its offset and, of an array, its length. */
export const structs: Record<string, { size: number, members: Record<string, [string, number, number?]> }>;
export const functions: Record<string, { parameters: [string, string][], returns: string | null }>;
/** Of each function to which nothing is copied: what makes a function for JavaScript of the module's. */
export const callers: Record<string, (
  expect: (count: number) => void, module: any, returned: (status: number) => any, result: number,
  ...converters: ((value: any, ...rest: any[]) => number)[]
) => (...values: any[]) => any>;
"""


def layout(struct, body):
    """The size of a struct, and its members: type, offset and, of an array, number of elements."""
    members, end, alignment = {}, 0, 1
    for line in filter(None, (part.strip() for part in body.split(";"))):
        member = re.fullmatch(r"(?:const )?(\w+\*?) (\w+)(?:\[(\d+)\])?", line)
        if not member or not (member[1] in MEMBERS or member[1].endswith("*")):
            sys.exit(f"{struct}: cannot lay out the member `{line}`; known types: {', '.join(MEMBERS)}")
        kind, size = MEMBERS.get(member[1], POINTER)
        offset = -(-end // size) * size
        members[member[2]] = [kind, offset] + ([int(member[3])] if member[3] else [])
        end = offset + size * int(member[3] or 1)
        alignment = max(alignment, size)
    return {"size": -(-end // alignment) * alignment, "members": members}


def parameter(declaration, structs):
    """The name of a parameter, and its type in JavaScript."""
    kind, name = re.fullmatch(r"(.*?) ?(\w+)", declaration).groups()
    ours = re.fullmatch(r"(?:const )?calligraphy_(\w+)\*", kind)
    if ours:
        return [name, f"struct {ours[1]}" if ours[1] in structs else "handle"]
    if kind not in PARAMETERS:
        sys.exit(f"cannot pass the parameter `{declaration}`; known types: {', '.join(PARAMETERS)}")
    return [name, PARAMETERS[kind]]


def function(returns, declaration, structs):
    """The parameters for which JavaScript passes arguments, and what it returns."""
    parameters = [part for part in re.sub(r"\s+", " ", declaration).split(", ") if part != "void"]
    if returns != "calligraphy_status":
        return {"parameters": [], "returns": "text"}
    last = re.sub(r" ?\w+$", "", parameters[-1])
    result = next((kind for pattern, kind in RESULTS.items() if re.fullmatch(pattern, last)), None)
    passed = [parameter(each, structs) for each in (parameters[:-1] if result else parameters)]
    return {"parameters": passed, "returns": result}


def is_copied(kind):
    """Whether an argument of this type is copied to the memory of the library."""
    return kind == "text" or kind.startswith(("read ", "write "))


def caller(function, parameters):
    """Each function has code of its own in JavaScript: that which several share cannot be compiled for the one that a
    page calls in each tick, and took as long as half a tick."""
    names = [name for name, _ in parameters]
    converted = "".join(f"to_{name}({name}), " for name in names)
    return (f"(_expect, _module, _returned, _result{''.join(f', to_{name}' for name in names)}) => "
            f"function ({', '.join(names)}) {{\n    _expect(arguments.length);\n"
            f"    return _returned(_module._calligraphy_{function}({converted}_result));\n  }}")


def interface(struct):
    """The name of a struct in TypeScript."""
    return "".join(part.capitalize() for part in struct.split("_"))


def declared_member(name, kind, _offset, count=None):
    """A member in TypeScript. One that is an array can be set from any array of its length."""
    if name == "size":
        return "readonly size: number"
    if count and kind != "char":
        return f"get {name}(): {kind}Array; set {name}(values: ArrayLike<number>)"
    return f"{name}: {'string' if count else 'number'}"


def declared_parameter(name, kind):
    """A parameter in TypeScript. Every pointer may be null there, though not all functions permit it."""
    access, _, of = kind.partition(" ")
    if access == "struct":
        return f"{name}: {interface(of)} | null"
    if access in ("read", "write"):
        return f"{name}: {'readonly number[] | ' if access == 'read' else ''}{of}Array | null"
    if name == "handle":
        return "handle: Handle | null"  # of any kind
    return f"{name}: " + {"handle": "Handle", "text": "string | null"}.get(kind, "number")


def declared_function(name, parameters, returns):
    passed = ", ".join(declared_parameter(*each) for each in parameters)
    return f"{name}({passed}): " + {"handle": "Handle", "text": "string", "number": "number", None: "void"}[returns]


def comments(text):
    """Those of the header: of each function, struct and constant by its name, of each member by its struct's and its
    own."""
    found = collections.defaultdict(str)

    def add(name, comment):
        words = " ".join(re.sub(r"^\s*///<? ?", "", line) for line in comment.strip().splitlines())
        if words:
            found[name] = f"/** {re.sub('calligraphy_', '', words, flags=re.I)} */ "

    for comment, name in re.findall(r"^((?:///.*\n)*)CALLIGRAPHY_API [\w* ]+ calligraphy_(\w+)\(", text, re.M):
        add(name, comment)
    for comment, name, body in re.findall(r"^((?:///.*\n)*)typedef struct calligraphy_(\w+) \{([^}]*)\}", text, re.M):
        add(name, comment)
        for member, comment in re.findall(r"(\w+)(?:\[\d+\])?;\s*(///<.*)", body):
            add(f"{name}.{member}", comment)
    for name, comment in re.findall(r"^  CALLIGRAPHY_(\w+) = \d+,?\s*(///<.*)", text, re.M):
        add(name, comment)
    return found


def declarations(structs, constants, functions, about):
    """The types of all, in TypeScript, with comments about them."""
    def block(head, lines):
        return f"{head} {{\n" + "".join(f"  {line};\n" for line in lines) + "}\n"

    return TYPES + "".join(
        block(f"{about[name]}export interface {interface(name)}", [
            *(about[f"{name}.{member}"] + declared_member(member, *place)
              for member, place in struct["members"].items()),
            "readonly address: number", f"values(): Values<{interface(name)}>"])
        for name, struct in structs.items()
    ) + "".join(block(*each) for each in (
        ("export interface Structs", [f"{name}: {interface(name)}" for name in structs]),
        ("export const constants:", [f"{about[name]}readonly {name}: number" for name in constants]),
        ("export interface Functions", [about[name] + declared_function(name, **each)
                                        for name, each in functions.items()])))


def constant(enumeration, line):
    found = re.fullmatch(r"CALLIGRAPHY_(\w+) = (\d+)", line.strip())
    if not found:
        sys.exit(f"{enumeration}: cannot read the constant `{line.strip()}`")
    return found[1], int(found[2])


def main():
    header, directory = map(pathlib.Path, sys.argv[1:])
    commented = header.read_text(encoding="utf-8")
    text = re.sub(r"//.*", "", commented)
    structs = {name: layout(name, body) for name, body in re.findall(r"struct calligraphy_(\w+) \{(.*?)\}", text, re.S)}
    constants = dict(constant(name, line) for name, body in re.findall(r"enum (\w+) \{(.*?)\}", text, re.S)
                     for line in body.split(","))
    functions = {name: function(returns, parameters, structs) for returns, name, parameters in re.findall(
        r"^CALLIGRAPHY_API ([\w* ]+) calligraphy_(\w+)\((.*?)\);", text, re.S | re.M)}

    callers = {name: caller(name, each["parameters"]) for name, each in functions.items()
               if each["parameters"] and not any(is_copied(kind) for _, kind in each["parameters"])}

    def table(name, values, written=json.dumps):
        lines = "".join(f"  {key}: {written(value)},\n" for key, value in values.items())
        return f"export const {name} = {{\n{lines}}};\n"

    (directory / "calligraphy_layout.js").write_text(
        "// @ts-nocheck: the types are in calligraphy_layout.d.ts\n"
        + table("structs", structs) + table("constants", constants) + table("functions", functions)
        + table("callers", callers, str))
    (directory / "calligraphy_layout.d.ts").write_text(
        declarations(structs, constants, functions, comments(commented)), encoding="utf-8")
    checks = [f"static_assert(sizeof(calligraphy_{name}) == {struct['size']});\n" + "".join(
        f"static_assert(offsetof(calligraphy_{name}, {member}) == {place[1]});\n"
        for member, place in struct["members"].items()) for name, struct in structs.items()]
    (directory / "layout_check.cpp").write_text("#include <calligraphy/c/calligraphy.h>\n" + "".join(checks))


if __name__ == "__main__":
    main()
