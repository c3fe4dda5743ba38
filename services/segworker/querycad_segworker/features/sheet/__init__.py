"""What has one wall thickness: plates, hollow sections, and how thick they are."""
