from evenbreak.cli.base import main as main
