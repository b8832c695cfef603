"""What an agent decides. Importing this package fills the catalogue with the built-in strategies."""

from shoal.strategies import knn_pso as knn_pso
from shoal.strategies.contract import CATALOGUE as CATALOGUE
from shoal.strategies.contract import Strategy as Strategy
from shoal.strategies.contract import strategy as strategy
