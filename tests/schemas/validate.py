"""Validate JSON documents against the published schemas: validate.py SCHEMAS DOCUMENTS.

DOCUMENTS has one line of JSON per case: {"schema": NAME, "case": …, "document": …}. A document must be valid and must not have
members that its schema does not list: future versions may add members, but all current members must be described. To make sure that a
schema does not accept everything, each member of the first documents is replaced by an invalid value, which must be rejected. Prints a
line `FAILED …` for each error; the last line has the counts.
"""

import copy
import json
import os
import pathlib
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError:
    # `cargo xtask test` reads this file.
    skipped = "SKIPPED schemas: jsonschema is not installed for Python"
    print(skipped)
    if log := os.environ.get("SKIP_LOG"):
        with open(log, "a", encoding="utf-8") as file:
            print(skipped, file=file)
    sys.exit(0)

# A value that no member of any document can have.
ABSURD = {"absurd": [{}]}
# The number of documents per schema that are varied, and the number of members per document.
VARIED_DOCUMENTS, VARIED_MEMBERS = 3, 400


def closed(schema, is_root=True):
    """Return the schema, closed to additional members."""
    if isinstance(schema, list):
        return [closed(part, False) for part in schema]
    if not isinstance(schema, dict):
        return schema
    result = {key: closed(part, False) for key, part in schema.items()}
    # A schema within another schema is extended where it is used, and is closed separately in its own file.
    is_embedded = "$id" in schema and not is_root
    is_object = isinstance(schema.get("properties"), dict) and "type" in schema
    if is_object and not is_embedded and "additionalProperties" not in schema:
        composed = "oneOf" in schema or "$ref" in schema
        result["unevaluatedProperties" if composed else "additionalProperties"] = False
    return result


def places(document, path=()):
    """Yield the paths of all members, including members of objects in lists."""
    if isinstance(document, dict):
        for key, value in document.items():
            yield path + (key,)
            yield from places(value, path + (key,))
    elif isinstance(document, list):
        for at, value in enumerate(document[:3]):
            yield from places(value, path + (at,))


def varied(document, path):
    """Return the document with an invalid value at a path."""
    other = copy.deepcopy(document)
    parent = other
    for step in path[:-1]:
        parent = parent[step]
    parent[path[-1]] = ABSURD
    return other


def main(schema_folder, document_file):
    validators = {}
    for path in sorted(pathlib.Path(schema_folder).glob("*.schema.json")):
        schema = json.loads(path.read_text(encoding="utf-8"))
        Draft202012Validator.check_schema(schema)
        name = path.name.removesuffix(".schema.json")
        validators[name] = (Draft202012Validator(schema), Draft202012Validator(closed(schema)))
    counts, faults, variations = dict.fromkeys(validators, 0), [], 0
    with open(document_file, encoding="utf-8") as lines:
        for line in lines:
            case = json.loads(line)
            name, document = case["schema"], case["document"]
            usual, strict = validators[name]
            for error in list(strict.iter_errors(document))[:3]:
                place = "/".join(map(str, error.absolute_path))
                faults.append(f"{case['case']} ({name}): at /{place}: {error.message[:300]}")
            counts[name] += 1
            if counts[name] > VARIED_DOCUMENTS:
                continue
            for path in list(places(document))[:VARIED_MEMBERS]:
                variations += 1
                if usual.is_valid(varied(document, path)):
                    place = "/".join(map(str, path))
                    faults.append(f"{case['case']} ({name}): anything is valid at /{place}")
    faults += [f"no document uses the schema {name}" for name, count in counts.items() if count == 0]
    for fault in faults:
        print("FAILED", fault)
    print(f"{sum(counts.values())} documents of {len(counts)} schemas, {variations} variations, {len(faults)} errors")
    sys.exit(1 if faults else 0)


main(*sys.argv[1:])
