"""What an agent decides. Importing this package fills the catalogue with the built-in strategies."""

from shoal.strategies import a_cmommt as a_cmommt
from shoal.strategies import attraction_repulsion as attraction_repulsion
from shoal.strategies import charged_pso as charged_pso
from shoal.strategies import constant_repulsion as constant_repulsion
from shoal.strategies import encircle as encircle
from shoal.strategies import expanding_square as expanding_square
from shoal.strategies import global_pso as global_pso
from shoal.strategies import knn_pso as knn_pso
from shoal.strategies import lattice as lattice
from shoal.strategies import lattice_intercept as lattice_intercept
from shoal.strategies import lattice_pursuit as lattice_pursuit
from shoal.strategies import levy_walk as levy_walk
from shoal.strategies import memory_pso as memory_pso
from shoal.strategies import parallel_track as parallel_track
from shoal.strategies import pursuit as pursuit
from shoal.strategies import random_walk as random_walk
from shoal.strategies import sector_search as sector_search
from shoal.strategies import shared_sighting as shared_sighting
from shoal.strategies.contract import CATALOGUE as CATALOGUE
from shoal.strategies.contract import Strategy as Strategy
from shoal.strategies.contract import strategy as strategy
