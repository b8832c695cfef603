"""What an agent decides. Importing this package fills the catalogue with the built-in strategies: its files."""

from shoal.compiler.kernel import kernel as kernel
from shoal.core.declared import import_marked
from shoal.strategies.contract import CATALOGUE as CATALOGUE
from shoal.strategies.contract import Strategy as Strategy
from shoal.strategies.contract import strategy as strategy

import_marked("shoal.strategies", "strategy")

TEMPLATES = ("linear",)  # of `shoal learn`, which writes a strategy; none is a strategy itself
RECOMMENDED = "cordon"  # what to take where nothing is known: docs/reference/arena-wide.md says how it fares
