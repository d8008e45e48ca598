"""`stillwater schema`: the recipe's JSON Schema."""

import json


def add_to(commands) -> None:
    parser = commands.add_parser("schema", help="print the JSON Schema of the recipe")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from ..recipe.schema import schema

    print(json.dumps(schema(), indent=2, ensure_ascii=False))
